#pragma once

#include "mesh/surface_mesh.h"
#include "render/mesh_store.h"
#include "scene/scene.h"

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace isoglass {

/// A mesh of the scene's files.
struct ObjectMesh {
    std::shared_ptr<const SurfaceMesh>
        mesh;                        ///< with normals, made from its triangles where the file lacks them
    std::vector<std::string> notes;  ///< what of the file could not be taken as it is, a sentence each
};

/// Throws Error where the file cannot be read, or holds positions that are no numbers.
ObjectMesh readObject(const MeshObject& object);

/// Meshes in the store of the renderer, each of them once. Belongs to the render thread.
class MeshUploads {
  public:
    /// Uploads those that are new, then releases those that are no longer there. The ids, in the same order.
    /// What was there stays drawable until then; where an upload throws, all is as it was.
    std::vector<MeshId> replace(const std::vector<std::shared_ptr<const SurfaceMesh>>& meshes,
                                MeshStore& store);

  private:
    std::map<std::shared_ptr<const SurfaceMesh>, MeshId> uploaded_;
};

}  // namespace isoglass
