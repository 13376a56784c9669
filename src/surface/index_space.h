#pragma once

#include "volume/lattice.h"

#include <glm/vec3.hpp>

#include <array>
#include <vector>

namespace isoglass {

/// Tables along one axis, indexed by lattice sample 0 .. cells.
struct AxisTable {
    std::vector<double> coordinate;  ///< world coordinate relative to the mesh origin
    /// Central difference on uneven steps, second order:
    /// df/dx = previous * (f[i] - f[i-1]) + next * (f[i+1] - f[i]).
    std::vector<float> previous;
    std::vector<float> next;
    /// One over the step before and after, for one-sided differences.
    std::vector<float> inversePrevious;
    std::vector<float> inverseNext;
};

/// The lattice as the extraction sees it: a periodic axis has one more sample, which closes it.
struct IndexSpace {
    explicit IndexSpace(const Lattice& lattice);

    /// Index of the stored sample at lattice index `i` of `axis`, or -1 outside the domain. Periodic
    /// axes wrap, so that differences across their ends are central.
    int storedIndex(int axis, int i) const;

    glm::ivec3 stored;  ///< samples in the key frames
    glm::ivec3 cells;
    glm::ivec3 bricks;  ///< of 8^3 samples, covering cells + 1 samples
    glm::bvec3 periodic;
    bool mirrored;      ///< index to world turns left-handed: triangles must be turned
    glm::dvec3 origin;  ///< of mesh positions
    std::array<AxisTable, 3> axes;
};

/// Origin for float positions: zero where floats resolve 1/1024 of the smallest step of every axis,
/// else the middle of the domain, rounded to whole units.
glm::dvec3 meshOrigin(const Lattice& lattice);

}  // namespace isoglass
