#pragma once

#include "surface/brick_field.h"
#include "surface/brick_surface.h"
#include "surface/index_space.h"

#include <glm/vec3.hpp>

namespace isoglass {

/// Makes the vertices of one gathered brick.
class VertexMaker {
  public:
    VertexMaker(const IndexSpace& space, glm::ivec3 brick, const BrickField& field, float iso)
        : space_(space), first_(brick * kBrickSize), field_(field), iso_(iso) {}

    /// Appends the vertex on the edge from local sample `low` in `direction` (bits x, y, z), whose ends
    /// must lie on different sides of the iso-value.
    void make(glm::ivec3 low, int direction, VertexBuffer& out) const;

  private:
    glm::vec3 gradient(glm::ivec3 sample) const;
    glm::dvec3 world(glm::ivec3 sample) const;

    const IndexSpace& space_;
    glm::ivec3 first_;
    const BrickField& field_;
    float iso_;
};

/// From the lower to the higher end of an edge in `direction` (bits x, y, z), in samples.
inline glm::ivec3 edgeVector(int direction) {
    return {direction & 1, direction >> 1 & 1, direction >> 2};
}

/// Where the surface crosses an edge whose ends lie on different sides of the iso-value.
struct EdgeCrossing {
    EdgeCrossing(const BrickField& field, glm::ivec3 low, glm::ivec3 high, float iso);

    double difference;  ///< f(high end) - f(low end), not zero
    double t;           ///< from the low end, in [0,1]
};

/// The normal at a crossing: minus the gradient interpolated between the ends, or `edgeNormal`.
glm::vec3 edgeBlendedNormal(glm::vec3 lowGradient, glm::vec3 highGradient, const EdgeCrossing& crossing,
                            glm::dvec3 edge);

/// A normal for an edge whose interpolated gradient is zero or not finite: the edge's own direction
/// from inside to outside, of the length that the difference along it gives, as far as floats can hold
/// it. `difference` = f(high end) - f(low end), not zero; `edge` = high end - low end, world.
glm::vec3 edgeNormal(double difference, glm::dvec3 edge);

}  // namespace isoglass
