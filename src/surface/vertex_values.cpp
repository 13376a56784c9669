#include "surface/vertex_values.h"

#include "base/error.h"
#include "basis/parallel.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace isoglass {

namespace {

constexpr std::size_t kVerticesPerTask = 4096;
constexpr float kMissing = std::numeric_limits<float>::quiet_NaN();

/// A place between two samples of an axis.
struct Place {
    int low, high;
    double weight;  ///< of `high`
};

/// Nothing outside the axis. Positions are floats: one that rounding moved over an end belongs to the end.
std::optional<Place> locate(const Axis& axis, double at) {
    const auto cells = static_cast<int>(axis.cells());
    const double first = axis.coordinate(0);
    const double last = axis.coordinate(axis.cells());
    if (axis.period) {
        const double turns = std::floor((at - std::min(first, last)) / *axis.period);
        at -= turns * *axis.period;
    }
    const double slack = 4 * std::numeric_limits<float>::epsilon() *
                         std::max({std::abs(first), std::abs(last), std::abs(first - last)});
    if (at < std::min(first, last) - slack || at > std::max(first, last) + slack) return std::nullopt;
    if (cells == 0) return Place{0, 0, 0};
    const auto isBefore = [&](int i) {
        return axis.descending() ? axis.coordinate(i) >= at : axis.coordinate(i) <= at;
    };
    // Where it is on an even axis; else by bisection.
    int low = std::clamp(static_cast<int>((at - first) / (last - first) * cells), 0, cells - 1);
    if ((low > 0 && !isBefore(low)) || (low + 1 < cells && isBefore(low + 1))) {
        low = 0;
        for (int high = cells; high - low > 1;) {
            const int middle = (low + high) / 2;
            (isBefore(middle) ? low : high) = middle;
        }
    }
    const double from = axis.coordinate(low);
    const double weight = (at - from) / (axis.coordinate(low + 1) - from);
    const int count = static_cast<int>(axis.size());
    return Place{low, (low + 1) % count, std::clamp(weight, 0.0, 1.0)};
}

/// Samples of weight 0 do not count, so that a missing neighbour does not spoil a vertex on the lattice.
double sampleFrame(const KeyFrame& frame, const std::array<Place, 3>& place) {
    double sum = 0;
    for (int corner = 0; corner < 8; ++corner) {
        glm::ivec3 at;
        double weight = 1;
        for (int k = 0; k < 3; ++k) {
            const bool high = corner >> k & 1;
            at[k] = high ? place[k].high : place[k].low;
            weight *= high ? place[k].weight : 1 - place[k].weight;
        }
        if (weight > 0) sum += weight * frame.sample(at);
    }
    return sum;
}

/// `valueAt` what lies at the place of each vertex.
template <typename ValueAt>
std::vector<float> atVertices(const SurfaceMesh& mesh, const Lattice& lattice, int threads,
                              const ValueAt& valueAt) {
    if (lattice.heights) {
        throw Error("samples that have heights of their own cannot be looked up by position yet",
                    "colour by a value", "use a series without heights");
    }
    std::vector<float> values(mesh.vertexCount());
    parallelFor(values.size(), kVerticesPerTask, threads, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const glm::dvec3 position = mesh.origin + glm::dvec3(mesh.positions[i]);
            std::array<Place, 3> place;
            bool inside = true;
            for (int k = 0; k < 3 && inside; ++k) {
                const auto found = locate(lattice.axes[k], position[k]);
                inside = found.has_value();
                if (inside) place[k] = *found;
            }
            values[i] = inside ? static_cast<float>(valueAt(place)) : kMissing;
        }
    });
    return values;
}

}  // namespace

std::vector<float> sampleAtVertices(const SurfaceMesh& mesh, const Lattice& lattice, const TimedField& field,
                                    int threads) {
    return atVertices(mesh, lattice, threads, [&](const std::array<Place, 3>& place) {
        if (field.fraction == 1) return sampleFrame(*field.b, place);
        const double a = sampleFrame(*field.a, place);
        if (field.fraction == 0) return a;
        return a + field.fraction * (sampleFrame(*field.b, place) - a);
    });
}

std::vector<float> changeAtVertices(const SurfaceMesh& mesh, const Lattice& lattice, const TimedField& field,
                                    int threads) {
    return atVertices(mesh, lattice, threads, [&](const std::array<Place, 3>& place) {
        return sampleFrame(*field.b, place) - sampleFrame(*field.a, place);
    });
}

std::vector<float> meanCurvature(const SurfaceMesh& mesh) {
    std::vector<double> divergence(mesh.vertexCount());
    std::vector<double> area(mesh.vertexCount());
    for (std::size_t t = 0; t < mesh.triangles.size(); t += 3) {
        const std::uint32_t* v = &mesh.triangles[t];
        std::array<glm::dvec3, 3> p, n;
        for (int i = 0; i < 3; ++i) {
            p[i] = mesh.positions[v[i]];
            n[i] = glm::normalize(glm::dvec3(mesh.normals[v[i]]));
        }
        const glm::dvec3 cross = glm::cross(p[1] - p[0], p[2] - p[0]);
        const double twiceArea = glm::length(cross);
        if (!(twiceArea > 0)) continue;
        // The gradient of vertex i's hat function is (unit normal x opposite edge) / (2 area).
        double timesTwiceArea = 0;
        for (int i = 0; i < 3; ++i) {
            const glm::dvec3 opposite = p[(i + 2) % 3] - p[(i + 1) % 3];
            timesTwiceArea += glm::dot(glm::cross(cross / twiceArea, opposite), n[i]);
        }
        for (int i = 0; i < 3; ++i) {
            divergence[v[i]] += timesTwiceArea;
            area[v[i]] += twiceArea;
        }
    }
    std::vector<float> curvature(mesh.vertexCount());
    for (std::size_t i = 0; i < curvature.size(); ++i)
        curvature[i] = area[i] > 0 ? static_cast<float>(divergence[i] / (2 * area[i])) : 0.0f;
    return curvature;
}

}  // namespace isoglass
