#include "volume/analytic.h"

#include "basis/parallel.h"
#include "volume/series_file.h"

#include <glm/geometric.hpp>

#include <cmath>

namespace isoglass {

float blobs(glm::dvec3 position, double time) {
    constexpr double kWidth = 0.12;
    double sum = 0;
    for (int i = 0; i < 8; ++i) {
        const glm::dvec3 centre(0.6 * std::cos(1.7 * i) + time, 0.6 * std::sin(2.3 * i),
                                0.6 * std::cos(3.1 * i + 1));
        const glm::dvec3 offset = position - centre;
        sum += std::exp(-glm::dot(offset, offset) / (2 * kWidth * kWidth));
    }
    return static_cast<float>(sum);
}

float growingSphere(glm::dvec3 position, double time) {
    return static_cast<float>(1 - glm::length(position) + 0.3 * time);
}

float gyroid(glm::dvec3 position, double time) {
    const glm::dvec3 p = 8.0 * position;
    const double drift = 4 * time;
    return static_cast<float>(std::cos(p.x + drift) * std::sin(p.y) + std::cos(p.y) * std::sin(p.z) +
                              std::cos(p.z) * std::sin(p.x + drift));
}

std::vector<float> sampleField(const Lattice& lattice, const AnalyticField& field, double time) {
    const glm::ivec3 dims = lattice.dims();
    const auto& axes = lattice.axes;
    std::vector<float> samples(static_cast<std::size_t>(dims.x) * dims.y * dims.z);
    parallelFor(dims.z, 1, 0, [&](std::size_t begin, std::size_t end) {
        for (std::size_t z = begin; z < end; ++z) {
            float* out = &samples[z * dims.x * dims.y];
            for (int y = 0; y < dims.y; ++y) {
                for (int x = 0; x < dims.x; ++x) {
                    *out++ =
                        field({axes[0].coordinates[x], axes[1].coordinates[y], axes[2].coordinates[z]}, time);
                }
            }
        }
    });
    return samples;
}

std::shared_ptr<const KeyFrame> makeAnalyticFrame(const Lattice& lattice, const AnalyticField& field,
                                                  double time) {
    return makeKeyFrame(lattice, sampleField(lattice, field, time));
}

Lattice makeUnitLattice(int count) {
    return makeUniformLattice(glm::ivec3(count), glm::dvec3(-1), glm::dvec3(2.0 / (count - 1)));
}

}  // namespace isoglass
