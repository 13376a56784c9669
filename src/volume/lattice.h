#pragma once

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace isoglass {

/// One axis of the sample lattice: the world coordinate of every sample.
struct Axis {
    std::string name;   ///< as in the source, e.g. "XAX_SUBSET"
    std::string units;  ///< as in the source, e.g. "degrees_east"; may be empty
    /// Strictly increasing or strictly decreasing, at least one value, in `units`.
    std::vector<double> coordinates;
    /// The source measured downwards (CF `positive: down`); `coordinates` are already negated.
    bool negated = false;
    /// Length after which the axis repeats (360 for a whole circle of longitude): one more cell joins
    /// the last sample to the first, so that there is no seam.
    std::optional<double> period;

    std::size_t size() const { return coordinates.size(); }
    bool descending() const { return coordinates.size() > 1 && coordinates.back() < coordinates.front(); }
    /// Number of cells along the axis: one less than the samples, as many where it is periodic.
    std::size_t cells() const { return period ? size() : size() - 1; }
    /// World coordinate of sample `index` for 0 <= index <= cells(): the sample that closes a periodic
    /// axis lies one period from the first.
    double coordinate(std::size_t index) const;
};

/// World heights that a field gives, one a sample and key frame, instead of the third axis table: levels
/// that follow the terrain, for instance. Linear in time between key frames, like the samples. Along every
/// column they go strictly the way of that axis, and every valid sample has one.
struct HeightField {
    std::string name;   ///< as the import was asked for it, e.g. "(PH+PHB)/9.81"
    std::string units;  ///< as in the source; empty where it is a formula
    double min = 0;     ///< over all key frames
    double max = 0;

    friend bool operator==(const HeightField&, const HeightField&) = default;
};

/// Where the samples are: three axis tables, x, y, z. World is right-handed with z up.
struct Lattice {
    std::array<Axis, 3> axes;
    /// Where set, the key frames bring the world z of every sample, and axes[2] is but their mean a level.
    std::optional<HeightField> heights;

    /// Samples along x, y, z.
    glm::ivec3 dims() const;
    /// Cells along x, y, z.
    glm::ivec3 cells() const;
    /// True when the mapping from index to world turns a right-handed triple into a left-handed one.
    bool mirrored() const;
    /// Smallest and largest world corner of the domain, at all times.
    std::array<glm::dvec3, 2> bounds() const;
};

/// Evenly spaced lattice, handy for generated fields: sample i of an axis lies at origin + i * spacing.
Lattice makeUniformLattice(glm::ivec3 dims, glm::dvec3 origin, glm::dvec3 spacing);

}  // namespace isoglass
