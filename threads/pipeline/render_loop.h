#pragma once

#include "basis/mailbox.h"
#include "pipeline/extraction_worker.h"
#include "render/renderer.h"
#include "scene/scene.h"

#include <cstdint>
#include <exception>
#include <functional>
#include <optional>
#include <thread>
#include <vector>

namespace isoglass {

/// When the render loop draws.
enum class Pace {
    newest,     ///< at once, with the newest meshes and camera there are; never waits (playback)
    everyMesh,  ///< once for every set of meshes, with the camera it was made for (batch)
};

/// What a drawn frame shows.
struct ShownFrame {
    std::uint64_t count = 0;  ///< frames drawn before it
    /// The finished request whose meshes are shown; null before the first one arrived.
    const FrameMeshes* meshes = nullptr;
};

/// The render thread: owns the GL context and every GL object, takes the newest meshes, draws.
///
/// A new set of meshes is uploaded whole before it takes the place of the old one, so no frame shows
/// parts of two sets.
class RenderLoop {
  public:
    struct Hooks {
        /// A finished set was taken, before it is drawn: the moment to ask for the next one. Optional.
        std::function<void(const FrameMeshes&)> taken = {};
        /// A frame was drawn; read it back from the renderer. False ends the loop.
        std::function<bool(const ShownFrame&, Renderer&)> present;
        /// The loop has ended, for whatever reason: nothing more is presented. Optional.
        std::function<void()> ended = {};
    };

    /// Starts the thread. `meshes` and `cameras` must outlive the loop. Hooks run on the render thread.
    RenderLoop(const Scene& scene, Pace pace, Mailbox<FrameMeshes>& meshes, Mailbox<CameraPose>& cameras,
               Hooks hooks);

    /// Asks the loop to end after the frame it is drawing. Any thread.
    void stop() { thread_.request_stop(); }

    /// Waits for the end of the loop and rethrows what ended it: a failed extraction, an Error of GL.
    void join();

  private:
    struct Uploaded;

    void run(std::stop_token stop);
    void draw(std::stop_token stop, Renderer& renderer);
    void replaceMeshes(Renderer& renderer, FrameMeshes meshes);
    FrameDescription describe(const CameraPose& camera) const;

    const Scene scene_;
    const Pace pace_;
    Mailbox<FrameMeshes>& incomingMeshes_;
    Mailbox<CameraPose>& incomingCameras_;
    const Hooks hooks_;
    std::optional<FrameMeshes> shown_;
    std::vector<SurfaceDraw> draws_;
    std::exception_ptr failure_;
    std::jthread thread_;  ///< last member: it uses all the others
};

/// How the scene's surfaces are drawn: placement, colour and opacity for each extracted mesh. The mesh
/// ids are left open.
std::vector<SurfaceDraw> surfaceDraws(const Scene& scene, const SceneMeshes& meshes);

/// The frame's description without its surfaces.
FrameDescription describeFrame(const Scene& scene, const CameraPose& camera);

}  // namespace isoglass
