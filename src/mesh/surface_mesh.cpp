#include "mesh/surface_mesh.h"

namespace isoglass {

std::size_t SurfaceMesh::bytes() const {
    return positions.size() * sizeof(glm::vec3) + normals.size() * sizeof(glm::vec3) +
           colorValues.size() * sizeof(float) + velocities.size() * sizeof(glm::vec3) +
           triangles.size() * sizeof(std::uint32_t);
}

}  // namespace isoglass
