#include "meshio/open_mesh.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace isoglass {

namespace {

OpenMesh::Vec3f toOpenMesh(glm::vec3 v) {
    return {v.x, v.y, v.z};
}
glm::vec3 fromOpenMesh(const OpenMesh::Vec3f& v) {
    return {v[0], v[1], v[2]};
}

/// In double precision, so that neither tiny nor huge vectors lose their direction; zero stays zero.
glm::vec3 unit(glm::dvec3 v) {
    const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    return largest > 0 ? glm::vec3(glm::normalize(v / largest)) : glm::vec3(0);
}

std::size_t indexOf(const OpenMesh::BaseHandle& handle) {
    return static_cast<std::size_t>(handle.idx());
}

}  // namespace

std::mutex OpenMeshSession::mutex_;

OpenMeshSession::OpenMeshSession() : lock_(mutex_) {
    omlog().disable();
    omout().disable();
    omerr().disable();
}

OpenMeshSession::~OpenMeshSession() {
    omlog().enable();
    omout().enable();
    omerr().enable();
}

OpenMesh::Vec3f SurfaceMeshExporter::point(OpenMesh::VertexHandle vertex) const {
    return toOpenMesh(mesh_.positions[indexOf(vertex)]);
}

OpenMesh::Vec3f SurfaceMeshExporter::normal(OpenMesh::VertexHandle vertex) const {
    return toOpenMesh(unit(mesh_.normals[indexOf(vertex)]));
}

OpenMesh::Vec3f SurfaceMeshExporter::normal(OpenMesh::FaceHandle face) const {
    const auto corner = [&](std::size_t i) {
        return glm::dvec3(mesh_.positions[mesh_.triangles[3 * indexOf(face) + i]]);
    };
    return toOpenMesh(unit(glm::cross(corner(1) - corner(0), corner(2) - corner(0))));
}

unsigned int SurfaceMeshExporter::get_vhandles(OpenMesh::FaceHandle face,
                                               std::vector<OpenMesh::VertexHandle>& vertices) const {
    vertices.resize(3);
    for (std::size_t i = 0; i < 3; ++i) {
        vertices[i] = OpenMesh::VertexHandle(static_cast<int>(mesh_.triangles[3 * indexOf(face) + i]));
    }
    return 3;
}

OpenMesh::VertexHandle SurfaceMeshImporter::add_vertex() {
    return add_vertex(OpenMesh::Vec3f(0, 0, 0));
}

OpenMesh::VertexHandle SurfaceMeshImporter::add_vertex(const OpenMesh::Vec3f& point) {
    mesh_.positions.push_back(fromOpenMesh(point));
    return OpenMesh::VertexHandle(static_cast<int>(mesh_.positions.size()) - 1);
}

OpenMesh::VertexHandle SurfaceMeshImporter::add_vertex(const OpenMesh::Vec3d& point) {
    return add_vertex(OpenMesh::Vec3f(point));
}

OpenMesh::FaceHandle SurfaceMeshImporter::add_face(const VHandles& vertices) {
    const auto isThere = [&](OpenMesh::VertexHandle vertex) {
        return vertex.is_valid() && indexOf(vertex) < mesh_.positions.size();
    };
    if (vertices.size() < 3 || !std::ranges::all_of(vertices, isThere)) {
        ++brokenFaces_;
        return OpenMesh::FaceHandle();
    }
    if (vertices.size() > 3) ++polygons_;
    for (std::size_t i = 2; i < vertices.size(); ++i) {
        for (const auto vertex : {vertices[0], vertices[i - 1], vertices[i]}) {
            mesh_.triangles.push_back(static_cast<std::uint32_t>(vertex.idx()));
        }
    }
    return OpenMesh::FaceHandle(static_cast<int>(faces_++));
}

void SurfaceMeshImporter::set_point(OpenMesh::VertexHandle vertex, const OpenMesh::Vec3f& point) {
    mesh_.positions.at(indexOf(vertex)) = fromOpenMesh(point);
}

void SurfaceMeshImporter::set_normal(OpenMesh::VertexHandle vertex, const OpenMesh::Vec3f& normal) {
    if (indexOf(vertex) >= mesh_.normals.size()) {
        mesh_.normals.resize(mesh_.positions.size());
        hasNormal_.resize(mesh_.positions.size());
    }
    glm::vec3& known = mesh_.normals.at(indexOf(vertex));
    const glm::vec3 given = fromOpenMesh(normal);
    if (hasNormal_[indexOf(vertex)] && known != given) normalsContradict_ = true;
    known = given;
    hasNormal_[indexOf(vertex)] = true;
}

void SurfaceMeshImporter::set_normal(OpenMesh::VertexHandle vertex, const OpenMesh::Vec3d& normal) {
    set_normal(vertex, OpenMesh::Vec3f(normal));
}

void SurfaceMeshImporter::dropPartialNormals() {
    const bool complete =
        hasNormal_.size() == mesh_.positions.size() && std::ranges::all_of(hasNormal_, std::identity());
    if (!complete || normalsContradict_) mesh_.normals.clear();
}

}  // namespace isoglass
