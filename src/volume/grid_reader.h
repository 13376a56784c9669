#pragma once

#include "volume/cf_packing.h"
#include "volume/netcdf_file.h"
#include "volume/staggering.h"

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace isoglass {

/// The dimensions of a series' lattice; variables are matched to them by name and length.
struct GridDimensions {
    std::array<CentredDimension, 3> axes;  ///< x, y, z
    std::optional<CentredDimension> time;
};

/// Brings one variable to the lattice of a series, one key frame at a time.
///
/// A staggered dimension is brought to the cell centres: every sample is the mean of the two neighbours,
/// missing where one of them is. A variable that lacks a dimension of the lattice, or time, is the same all
/// along it. Use from one thread at a time; `file` must outlive the reader.
class GridReader {
  public:
    /// Throws Error where a dimension of more than one sample is none of the lattice's, by name or length.
    GridReader(const NetcdfFile& file, const NetcdfVariable& variable, const GridDimensions& grid);

    /// Reads key frame `frame` into `samples`: x fastest, missing samples as NaN. Throws Error.
    void read(std::size_t frame, std::span<float> samples);

    /// What was done to bring the variable to the lattice, a sentence each.
    const std::vector<std::string>& notes() const { return notes_; }

  private:
    /// One axis as the file stores it.
    struct Extent {
        std::optional<std::size_t> position;  ///< in the variable's dimensions; none where it lacks the axis
        std::size_t length = 1;               ///< at the cell centres
        std::size_t staggered = 0;            ///< samples more that the file has: 0 or 1
        std::size_t stride = 0;               ///< how far apart neighbours lie in a key frame (x fastest)

        std::size_t stored(std::size_t centres) const { return centres + staggered; }
    };

    void match(std::size_t position, const GridDimensions& grid);
    void readSlab(std::vector<std::size_t>& start, std::vector<std::size_t>& count, std::size_t first,
                  std::size_t planes);
    void scatter(std::size_t first, std::size_t planes, std::span<float> out) const;
    void repeat(std::span<float> samples) const;

    const NetcdfFile& file_;
    const NetcdfVariable& variable_;
    std::unique_ptr<SampleReader> reader_;
    std::array<std::size_t, 3> dims_;
    std::array<Extent, 3> axes_;    ///< x, y, z
    std::array<Extent, 3> stored_;  ///< the same, slowest in the file first
    std::optional<std::size_t> time_;
    bool whole_ = true;  ///< the variable has all three axes
    std::vector<float> slab_;
    std::vector<float> compact_;  ///< a key frame without the axes that the variable lacks
    std::vector<std::string> notes_;
};

}  // namespace isoglass
