#pragma once

#include "surface/index_space.h"
#include "volume/lattice.h"

#include <glm/vec3.hpp>

#include <array>
#include <vector>

namespace isoglass {

/// The lattices of all levels in one frame of reference.
///
/// Sample i of level l lies at level-0 index i * 2^l. Levels reach up to one brick of the top level, beyond
/// the end of the domain: there the field has the value at the nearest index, and world coordinates go on
/// with the last step.
struct LevelSpace {
    explicit LevelSpace(const Lattice& lattice);

    int top() const { return static_cast<int>(levels.size()) - 1; }
    /// Cells of `level` that lie at least partly in the domain; also its last sample.
    glm::ivec3 cellsAt(int level) const { return (cells + ((1 << level) - 1)) >> level; }
    glm::dvec3 position(glm::ivec3 index) const {
        return {coordinate[0][index.x], coordinate[1][index.y], coordinate[2][index.z]};
    }

    glm::ivec3 cells;                               ///< of level 0
    std::array<std::vector<double>, 3> coordinate;  ///< world, relative to the mesh origin, by level-0 index
    std::array<double, 3> largestStep;              ///< of `coordinate`, positive
    std::vector<IndexSpace> levels;                 ///< for gathering bricks and differences, level 0 first
};

}  // namespace isoglass
