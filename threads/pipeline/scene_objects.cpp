#include "pipeline/scene_objects.h"

#include "base/error.h"
#include "mesh/vertex_normals.h"
#include "meshio/mesh_file.h"

#include <algorithm>
#include <cmath>

namespace isoglass {

namespace {

bool isFinite(const glm::vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// One that has no direction would be black from everywhere.
bool isUsable(const glm::vec3& normal) {
    return isFinite(normal) && normal != glm::vec3(0);
}

}  // namespace

ObjectMesh readObject(const MeshObject& object) {
    MeshFileLosses losses;
    SurfaceMesh mesh = readMesh(object.file, &losses);
    const auto bad = std::ranges::find_if_not(mesh.positions, isFinite);
    if (bad != mesh.positions.end()) {
        throw Error(
            "the position of vertex " + std::to_string(bad - mesh.positions.begin()) + " is no number",
            object.file.string());
    }
    if (mesh.normals.empty() || !std::ranges::all_of(mesh.normals, isUsable)) addNormals(mesh);
    ObjectMesh read;
    const std::string file = object.file.string() + ": ";
    if (losses.polygons > 0)
        read.notes.push_back(file + "faces with more than three corners, split into triangles: " +
                             std::to_string(losses.polygons));
    if (losses.refused > 0)
        read.notes.push_back(file + "triangles without area, left out: " + std::to_string(losses.refused));
    if (mesh.empty()) read.notes.push_back(file + "the mesh is empty");
    read.mesh = std::make_shared<const SurfaceMesh>(std::move(mesh));
    return read;
}

std::vector<MeshId> MeshUploads::replace(const std::vector<std::shared_ptr<const SurfaceMesh>>& meshes,
                                         MeshStore& store) {
    std::vector<MeshId> ids;
    std::map<std::shared_ptr<const SurfaceMesh>, MeshId> needed;
    for (const auto& mesh : meshes) {
        auto found = needed.find(mesh);
        if (found == needed.end()) {
            const auto known = uploaded_.find(mesh);
            found =
                needed.emplace(mesh, known != uploaded_.end() ? known->second : store.upload(*mesh)).first;
        }
        ids.push_back(found->second);
    }
    for (const auto& [mesh, id] : uploaded_) {
        if (!needed.contains(mesh)) store.release(id);
    }
    uploaded_ = std::move(needed);
    return ids;
}

}  // namespace isoglass
