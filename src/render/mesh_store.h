#pragma once

#include "gl/context.h"
#include "gl/objects.h"
#include "mesh/surface_mesh.h"
#include "render/camera.h"

#include <cstdint>
#include <map>
#include <memory>
#include <optional>

namespace isoglass {

/// Names an uploaded mesh; never used again after its release.
enum class MeshId : std::uint64_t {};

/// A mesh in the memory of the GPU; immutable.
struct GpuMesh {
    gl::Buffer positions;
    gl::Buffer normals;
    gl::Buffer triangles;
    std::optional<gl::Buffer> colorValues;  ///< only of meshes that have them
    std::optional<gl::Buffer> velocities;   ///< only of meshes that have them
    gl::VertexArray vertexArray;
    std::int32_t indexCount;
    glm::dvec3 origin;  ///< of the positions, in series coordinates
    Bounds bounds;      ///< relative to `origin`; of no meaning where indexCount is 0
    /// The surface lies in a plane along two axes of the series: no ray out of that plane meets it twice,
    /// because an iso-surface does not run over itself.
    bool flat;
};

/// The meshes of the render thread. All members belong to that thread.
///
/// A mesh is in the store only when it is whole, and stays drawable until it is released, so a new one
/// can be uploaded while the old one is shown.
class MeshStore {
  public:
    /// `context` must outlive the store and be current.
    explicit MeshStore(gl::Context& context) : context_(context) {}

    /// Copies the mesh. Throws Error where it does not fit the GPU; the store is then as it was.
    MeshId upload(const SurfaceMesh& mesh);
    /// Frees the mesh. An id that is not in the store is a mistake of the caller: std::invalid_argument.
    void release(MeshId id);

    /// Throws std::invalid_argument for an id that is not in the store.
    const GpuMesh& get(MeshId id) const;
    std::size_t count() const { return meshes_.size(); }
    /// Bytes that all meshes hold on the GPU.
    std::size_t bytes() const;

  private:
    gl::Context& context_;
    std::map<MeshId, GpuMesh> meshes_;
    std::uint64_t lastId_ = 0;
};

}  // namespace isoglass
