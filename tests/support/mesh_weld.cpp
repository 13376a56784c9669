#include "support/mesh_weld.h"

#include <array>
#include <map>

namespace isoglass::test {

SurfaceMesh weldByPosition(const SurfaceMesh& mesh) {
    SurfaceMesh welded;
    welded.origin = mesh.origin;
    std::map<std::array<float, 3>, std::uint32_t> places;
    std::vector<std::uint32_t> vertexOf;
    for (std::size_t v = 0; v < mesh.vertexCount(); ++v) {
        const glm::vec3& p = mesh.positions[v];
        const auto next = static_cast<std::uint32_t>(welded.vertexCount());
        const auto [place, isNew] = places.try_emplace({p.x, p.y, p.z}, next);
        vertexOf.push_back(place->second);
        if (!isNew) continue;
        welded.positions.push_back(p);
        welded.normals.push_back(mesh.normals[v]);
    }
    for (const std::uint32_t v : mesh.triangles) welded.triangles.push_back(vertexOf[v]);
    return welded;
}

}  // namespace isoglass::test
