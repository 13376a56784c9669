#pragma once

#include "volume/lattice.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <limits>
#include <span>
#include <string>
#include <vector>

// World heights given by a field, one a sample, instead of by the third axis table. Private to the room.

namespace isoglass {

/// The mean height of every level, for the third axis table: it goes the way that the columns go. Built from
/// the mean steps, so that columns which end early do not disturb it. `heights` are dense, x fastest, NaN =
/// missing; `name` is for messages. Throws Error where no column has two successive levels, or where the
/// means do not strictly increase or decrease.
std::vector<double> meanHeights(glm::ivec3 dims, std::span<const float> heights, const std::string& name);

/// Checks heights as they come, one key frame after the other, against what extraction relies on.
class HeightCheck {
  public:
    /// `lattice.axes[2]` says whether heights increase or decrease with the index, `lattice.heights` names
    /// them.
    explicit HeightCheck(const Lattice& lattice);

    /// Throws Error, naming sample and key frame, where a sample has a value but no height, and where heights
    /// along a column do not strictly go the way of the axis. Both dense, x fastest, NaN = missing.
    void add(std::size_t frame, std::span<const float> samples, std::span<const float> heights);

    /// Throws Error where there was no height at all, and where successive heights of a column lie so close
    /// that they might meet between key frames, by rounding to floats.
    void finish() const;

    double min() const { return min_; }
    double max() const { return max_; }

  private:
    void addStep(std::size_t frame, glm::ivec3 lower, float below, float above);
    std::string place(std::size_t frame, glm::ivec3 sample) const;

    glm::ivec3 dims_;
    std::string name_;
    bool descending_;
    double min_ = std::numeric_limits<double>::infinity();
    double max_ = -std::numeric_limits<double>::infinity();
    double smallestStep_ = std::numeric_limits<double>::infinity();
    std::string smallestStepPlace_;
};

}  // namespace isoglass
