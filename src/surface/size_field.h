#pragma once

#include "surface/error_sizes.h"
#include "surface/extract.h"
#include "surface/level_space.h"
#include "surface/view.h"
#include "volume/missing_distance.h"

#include <glm/vec3.hpp>

#include <array>
#include <optional>
#include <span>
#include <vector>

namespace isoglass {

/// A node of the octree over the lattice: 8^3 cells of a level, from cell 8 * brick on.
struct LevelBrick {
    int level = 0;
    glm::ivec3 brick{0};

    friend bool operator==(const LevelBrick&, const LevelBrick&) = default;
};

/// How far missing samples are, for each key frame that takes part.
std::vector<const MissingDistance*> missingIn(const TimedField& field);

/// The cell size that is allowed at each lattice vertex, in units of the level-0 cell: at least 1, continuous
/// in position and eye, and so slow that it grows by less than the cell size across any brick.
///
/// The size of a cell is its longest edge. By the distance metric a cell takes at most `cellPixels` of the
/// screen: size = max(1, cellPixels * distance / (pixelsPerUnit * largest step)). By the error metric it is
/// that of ErrorSizes. Where cells touch missing samples it is 1, and grows from there no faster than it may,
/// so that no level above 0 meets them.
///
/// Everything that is drawn depends on these sizes alone. Pure; any number of threads may ask.
class SizeField {
  public:
    /// `missing` has one entry for each key frame that takes part; they must outlive the field.
    SizeField(const LevelSpace& space, const View& view, std::vector<const MissingDistance*> missing = {});
    /// By the metric that the view asks for, for one surface at one moment: `field` is level 0.
    SizeField(const LevelSpace& space, const View& view, const TimedField& field, float iso, int threads);

    /// At a level-0 index, which may lie in the padding beyond the domain.
    float at(glm::ivec3 index) const;
    /// At the 9^3 vertices of a brick, z fastest, bit by bit as `at`.
    void inBrick(LevelBrick node, std::span<float> sizes) const;
    /// Smallest over the lattice vertices of a closed brick.
    float smallest(LevelBrick node) const;
    /// A bound for the sizes in a closed brick.
    float largest(LevelBrick node) const;

    /// By how many cells of a brick's level sizes grow over its diagonal at most; below 1.
    float growthPerBrick() const { return growthPerBrick_; }

    /// Whether the surface may be made of cells of the node's level there: sizes are at least that of its
    /// cells, with a margin for rounding.
    bool isCoarseEnough(LevelBrick node) const;

  private:
    float missingLimit(glm::ivec3 index) const;
    float largestByDistance(LevelBrick node) const;

    struct Range {
        int begin, end;
    };
    static Range indices(LevelBrick node, int axis) {
        const int begin = node.brick[axis] * (kBrickSize << node.level);
        return {begin, begin + (kBrickSize << node.level)};
    }

    float growthPerBrick_ = 0;
    /// Squared part of each axis in the distance, in units of size, by level-0 index; falls, then rises.
    std::array<std::vector<float>, 3> squares_;
    std::array<int, 3> nearest_;                   ///< index of the smallest one
    std::vector<const MissingDistance*> missing_;  ///< those that are not empty
    std::optional<ErrorSizes> errors_;
};

}  // namespace isoglass
