#include "surface/motion.h"

#include "surface/vertex_values.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace isoglass {

namespace {

/// Longer velocities point nowhere: the gradient vanishes. In steps of the lattice.
constexpr double kLongest = 1e6;

}  // namespace

std::vector<glm::vec3> normalVelocities(const SurfaceMesh& mesh, const Lattice& lattice,
                                        const TimedField& field, const ExtractOptions& options) {
    if (lattice.heights || field.fraction <= 0 || field.fraction >= 1) return {};
    const std::vector<float> changes = changeAtVertices(mesh, lattice, field, options.threads);
    // Normals are -G, or G where the inside is below.
    const double sign = options.insideIsBelow ? -1 : 1;
    const double longest = kLongest * motionLimit(lattice);
    std::vector<glm::vec3> velocities(mesh.vertexCount());
    for (std::size_t i = 0; i < velocities.size(); ++i) {
        const double change = changes[i];
        if (!std::isfinite(change)) continue;
        const glm::dvec3 normal(mesh.normals[i]);
        const glm::dvec3 velocity = normal * (sign * change / glm::dot(normal, normal));
        const double length = glm::length(velocity);
        if (!std::isfinite(length)) continue;
        velocities[i] = glm::vec3(length > longest ? longest / length * velocity : velocity);
    }
    return velocities;
}

glm::vec3 displacement(const glm::vec3& velocity, float motion, float limit) {
    const glm::vec3 moved = motion * velocity;
    const float far = glm::length(moved);
    return far > limit ? limit / far * moved : moved;
}

double motionLimit(const Lattice& lattice) {
    double smallest = std::numeric_limits<double>::infinity();
    for (const Axis& axis : lattice.axes) {
        for (std::size_t i = 0; i < axis.cells(); ++i)
            smallest = std::min(smallest, std::abs(axis.coordinate(i + 1) - axis.coordinate(i)));
    }
    return std::isfinite(smallest) ? smallest : 0;
}

}  // namespace isoglass
