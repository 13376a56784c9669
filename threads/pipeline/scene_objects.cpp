#include "pipeline/scene_objects.h"

#include "base/error.h"
#include "mesh/vertex_normals.h"
#include "meshio/mesh_file.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

namespace isoglass {

namespace {

bool isFinite(const glm::vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// Of vertices that triangles name: one without direction would be black from everywhere.
std::size_t countUnusableNormals(const SurfaceMesh& mesh) {
    if (mesh.normals.empty()) return 0;
    std::vector<bool> isNamed(mesh.vertexCount());
    for (const std::uint32_t vertex : mesh.triangles) isNamed[vertex] = true;
    std::size_t count = 0;
    for (std::size_t i = 0; i < mesh.vertexCount(); ++i) {
        const glm::vec3& normal = mesh.normals[i];
        count += isNamed[i] && (!isFinite(normal) || normal == glm::vec3(0));
    }
    return count;
}

/// Normals say where outside is; where most triangles are wound the other way, all are turned.
void makeWindingAgree(SurfaceMesh& mesh) {
    double agreement = 0;
    for (std::size_t i = 0; i < mesh.triangles.size(); i += 3) {
        const auto corner = [&](std::size_t k) { return mesh.triangles[i + k]; };
        const auto position = [&](std::size_t k) { return glm::dvec3(mesh.positions[corner(k)]); };
        glm::dvec3 normal(0);
        for (std::size_t k = 0; k < 3; ++k) normal += glm::dvec3(mesh.normals[corner(k)]);
        agreement += glm::dot(glm::cross(position(1) - position(0), position(2) - position(0)), normal);
    }
    if (!(agreement < 0)) return;
    for (std::size_t i = 0; i < mesh.triangles.size(); i += 3)
        std::swap(mesh.triangles[i + 1], mesh.triangles[i + 2]);
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
    ObjectMesh read;
    const std::string file = object.file.string() + ": ";
    if (const std::size_t unusable = countUnusableNormals(mesh); mesh.normals.empty() || unusable > 0) {
        if (unusable > 0)
            read.notes.push_back(
                file + "normals without a direction, so all are made anew: " + std::to_string(unusable));
        addNormals(mesh);
    }
    makeWindingAgree(mesh);
    if (losses.polygons > 0)
        read.notes.push_back(file + "faces with more than three corners, split into triangles: " +
                             std::to_string(losses.polygons));
    if (losses.refused > 0)
        read.notes.push_back(
            file + "triangles that name one position twice, left out: " + std::to_string(losses.refused));
    if (mesh.empty()) read.notes.push_back(file + "the mesh is empty");
    read.mesh = std::make_shared<const SurfaceMesh>(std::move(mesh));
    return read;
}

std::vector<MeshId> MeshUploads::replace(const std::vector<std::shared_ptr<const SurfaceMesh>>& meshes,
                                         MeshStore& store) {
    std::vector<MeshId> ids;
    std::map<std::shared_ptr<const SurfaceMesh>, MeshId> needed;
    try {
        for (const auto& mesh : meshes) {
            auto found = needed.find(mesh);
            if (found == needed.end()) {
                const auto known = uploaded_.find(mesh);
                found = needed.emplace(mesh, known != uploaded_.end() ? known->second : store.upload(*mesh))
                            .first;
            }
            ids.push_back(found->second);
        }
    } catch (...) {
        for (const auto& [mesh, id] : needed) {
            if (!uploaded_.contains(mesh)) store.release(id);
        }
        throw;
    }
    for (const auto& [mesh, id] : uploaded_) {
        if (!needed.contains(mesh)) store.release(id);
    }
    uploaded_ = std::move(needed);
    return ids;
}

}  // namespace isoglass
