#pragma once

#include "mesh/surface_mesh.h"

#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

#include <cstddef>
#include <mutex>
#include <vector>

// Private to the room: it includes OpenMesh.

namespace isoglass {

/// Sole use of OpenMesh's readers and writers, which are global objects with state, and silence on their
/// log streams as long as it lives.
class OpenMeshSession {
  public:
    OpenMeshSession();
    ~OpenMeshSession();
    OpenMeshSession(const OpenMeshSession&) = delete;
    OpenMeshSession& operator=(const OpenMeshSession&) = delete;

  private:
    static std::mutex mutex_;
    std::scoped_lock<std::mutex> lock_;
};

using OpenMeshKernel = OpenMesh::TriMesh_ArrayKernelT<>;

/// Shows a SurfaceMesh to OpenMesh's writers. They read vertices and faces one by one, so nothing is
/// copied, and since no half-edge mesh is built, no face can be refused for being non-manifold.
class SurfaceMeshExporter final : public OpenMesh::IO::ExporterT<OpenMeshKernel> {
  public:
    explicit SurfaceMeshExporter(const SurfaceMesh& mesh) : ExporterT(kernel_), mesh_(mesh) {}

    OpenMesh::Vec3f point(OpenMesh::VertexHandle vertex) const override;
    OpenMesh::Vec3f normal(OpenMesh::VertexHandle vertex) const override;
    OpenMesh::Vec3f normal(OpenMesh::FaceHandle face) const override;
    unsigned int get_vhandles(OpenMesh::FaceHandle face,
                              std::vector<OpenMesh::VertexHandle>& vertices) const override;
    std::size_t n_vertices() const override { return mesh_.vertexCount(); }
    std::size_t n_faces() const override { return mesh_.triangleCount(); }
    bool has_vertex_normals() const override { return mesh_.normals.size() == mesh_.positions.size(); }
    bool has_face_normals() const override { return true; }

  private:
    OpenMeshKernel kernel_;  ///< empty; writers ask it for properties to write besides
    const SurfaceMesh& mesh_;
};

/// Receives what OpenMesh's readers find, as a SurfaceMesh; takes any face with valid vertices.
class SurfaceMeshImporter final : public OpenMesh::IO::ImporterT<OpenMeshKernel> {
  public:
    explicit SurfaceMeshImporter(SurfaceMesh& mesh) : ImporterT(kernel_), mesh_(mesh) {}

    OpenMesh::VertexHandle add_vertex() override;
    OpenMesh::VertexHandle add_vertex(const OpenMesh::Vec3f& point) override;
    OpenMesh::VertexHandle add_vertex(const OpenMesh::Vec3d& point) override;
    OpenMesh::FaceHandle add_face(const VHandles& vertices) override;
    void set_point(OpenMesh::VertexHandle vertex, const OpenMesh::Vec3f& point) override;
    void set_normal(OpenMesh::VertexHandle vertex, const OpenMesh::Vec3f& normal) override;
    void set_normal(OpenMesh::VertexHandle vertex, const OpenMesh::Vec3d& normal) override;
    void set_normal(OpenMesh::FaceHandle, const OpenMesh::Vec3f&) override {}
    void set_normal(OpenMesh::FaceHandle, const OpenMesh::Vec3d&) override {}
    void add_face_texcoords(OpenMesh::FaceHandle, OpenMesh::VertexHandle,
                            const std::vector<OpenMesh::Vec2f>&) override {}
    void add_face_texcoords(OpenMesh::FaceHandle, OpenMesh::VertexHandle,
                            const std::vector<OpenMesh::Vec3f>&) override {}
    void reserve(unsigned int, unsigned int, unsigned int) override {}
    std::size_t n_vertices() const override { return mesh_.vertexCount(); }
    std::size_t n_faces() const override { return faces_; }

    /// Faces with more than three corners.
    std::size_t polygons() const { return polygons_; }
    /// Faces that name a vertex which is not there, or fewer than three.
    std::size_t brokenFaces() const { return brokenFaces_; }
    /// Drops the normals unless every vertex was given one, and no vertex several that differ: .obj has one
    /// for each corner of a face.
    void dropPartialNormals();

  private:
    OpenMeshKernel kernel_;
    SurfaceMesh& mesh_;
    std::size_t faces_ = 0;
    std::size_t polygons_ = 0;
    std::size_t brokenFaces_ = 0;
    std::vector<bool> hasNormal_;
    bool normalsContradict_ = false;
};

}  // namespace isoglass
