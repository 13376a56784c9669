#pragma once

#include "volume/lattice.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <numbers>
#include <vector>

// A lattice whose levels follow a terrain that changes with time, given by a formula.

namespace isoglass::test {

/// Levels from a hilly ground up to a flat top, closer together near the ground; mirrored by choice.
struct TerrainLattice {
    Lattice lattice;
    double top = 2;
    bool levelsDescend = false;  ///< the first level is the top

    /// x over [0,4], y over [0,3] with uneven steps.
    explicit TerrainLattice(glm::ivec3 dims, int mirror = 0) {
        lattice = makeUniformLattice(dims, glm::dvec3(0), glm::dvec3(1));
        for (int k = 0; k < 2; ++k) {
            auto& coordinates = lattice.axes[k].coordinates;
            for (std::size_t i = 0; i < coordinates.size(); ++i) {
                const double s = static_cast<double>(i) / static_cast<double>(coordinates.size() - 1);
                coordinates[i] = (4 - k) * (s + 0.1 * s * (1 - s));
            }
            if (mirror >> k & 1) std::reverse(coordinates.begin(), coordinates.end());
        }
        levelsDescend = mirror >> 2 & 1;
        auto& levels = lattice.axes[2].coordinates;
        for (std::size_t k = 0; k < levels.size(); ++k) levels[k] = height(0, 0, share(k), 0);
        lattice.heights = HeightField{"terrain", "", -1, top};
    }

    double ground(double x, double y, double time) const {
        return 0.4 * std::sin(1.3 * x + time) * std::cos(1.1 * y) - 0.1;
    }
    /// World z at `share` of the way from the ground to the top.
    double height(double x, double y, double share, double time) const {
        const double low = ground(x, y, time);
        return low + std::pow(share, 1.3) * (top - low);
    }
    double share(std::size_t level) const {
        const double s = static_cast<double>(level) / static_cast<double>(lattice.axes[2].size() - 1);
        return levelsDescend ? 1 - s : s;
    }

    /// Dense heights at one time, x fastest.
    std::vector<float> heights(double time) const {
        const auto& [x, y, z] = lattice.axes;
        std::vector<float> result;
        for (std::size_t k = 0; k < z.size(); ++k)
            for (const double yj : y.coordinates)
                for (const double xi : x.coordinates)
                    result.push_back(static_cast<float>(height(xi, yj, share(k), time)));
        return result;
    }

    /// A field of world position, at the samples that lie at `heights`.
    std::vector<float> sample(const std::vector<float>& heights,
                              const std::function<double(glm::dvec3)>& field) const {
        const auto& [x, y, z] = lattice.axes;
        std::vector<float> result;
        for (std::size_t k = 0; k < z.size(); ++k)
            for (const double yj : y.coordinates)
                for (const double xi : x.coordinates)
                    result.push_back(static_cast<float>(field({xi, yj, heights[result.size()]})));
        return result;
    }
};

}  // namespace isoglass::test
