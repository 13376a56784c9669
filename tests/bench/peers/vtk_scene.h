#pragma once

#include "mesh/surface_mesh.h"
#include "scene/scene.h"

#include <memory>
#include <vector>

namespace isoglass {

/// A surface to draw in a comparison.
struct PeerSurface {
    SurfaceMesh mesh;
    LinearColor color;
    float opacity;
};

/// How VTK composes.
struct VtkWay {
    int peels = 0;  ///< most passes of dual depth peeling; 0 is VTK's default, weighted transparency
};

/// The surfaces in an off-screen window of VTK. Needs an X server.
class VtkScene {
  public:
    VtkScene(const std::vector<PeerSurface>& surfaces, int side, VtkWay way);
    ~VtkScene();

    /// Turns the camera by this much from its first place and draws; waits for the end.
    void draw(double azimuthDegrees);

  private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace isoglass
