#pragma once

#include "basis/bell.h"
#include "basis/mailbox.h"
#include "gl/current_context.h"
#include "pipeline/extraction_worker.h"
#include "pipeline/scene_objects.h"
#include "render/renderer.h"
#include "scene/scene.h"

#include <cstdint>
#include <exception>
#include <functional>
#include <memory>
#include <optional>
#include <thread>
#include <vector>

namespace isoglass {

/// When the render loop draws.
enum class Pace {
    /// Once at the start, then whenever the bell of its inbox was rung, with the newest meshes and view
    /// there are; never waits for meshes (a window).
    newest,
    everyMesh,  ///< once for every set of meshes, with the camera it was made for (batch)
};

/// How the meshes are looked at.
struct RenderView {
    CameraPose camera;
    glm::ivec2 size{0};      ///< of the image in pixels
    bool wireframe = false;  ///< see FrameDescription
    /// On the timeline: meshes of another moment that have velocities are moved there, as far as they can,
    /// never across a key frame. Without it they are shown as they are.
    std::optional<double> position = {};
    std::optional<IllustrativeStyle> illustration = {};  ///< then no ray goes through a volume

    friend bool operator==(const RenderView&, const RenderView&) = default;
};

/// What other threads hand to the render thread.
struct RenderInbox {
    Bell news;  ///< rings when one of the boxes gets something; ring it to have a frame drawn again
    Mailbox<FrameMeshes> meshes{&news};
    Mailbox<RenderView> views{&news};
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
/// parts of two sets. Where nothing changes nothing is drawn: the thread sleeps.
class RenderLoop {
  public:
    /// All run on the render thread.
    struct Hooks {
        /// Makes the context that the loop draws with; without one it is a HeadlessContext.
        std::function<std::unique_ptr<gl::CurrentContext>()> makeContext = {};
        /// News came, and nothing of it was taken yet: whatever was posted before something that this hook
        /// finds will be in the next frame. In batch there may be none. Optional.
        std::function<void()> woken = {};
        /// A finished set was taken, before it is drawn: the moment to ask for the next one. Optional.
        std::function<void(const FrameMeshes&)> taken = {};
        /// A set could not be made: its failure and request. The old meshes stay. Without this hook the
        /// loop ends and `join` rethrows.
        std::function<void(const FrameMeshes&)> failed = {};
        /// A frame was drawn; read it back or show it. False ends the loop.
        std::function<bool(const ShownFrame&, Renderer&)> present;
        /// The loop has ended, for whatever reason, and its context is gone. Optional.
        std::function<void()> ended = {};
    };

    /// Starts the thread. `inbox` must outlive the loop.
    RenderLoop(const Scene& scene, Pace pace, RenderInbox& inbox, Hooks hooks);

    /// Asks the loop to end after the frame it is drawing. Any thread.
    void stop() { thread_.request_stop(); }

    /// Waits for the end of the loop and rethrows what ended it: a failed extraction, an Error of GL.
    void join();

  private:
    void run(std::stop_token stop);
    void draw(std::stop_token stop, Renderer& renderer);
    bool takeMeshes(Renderer& renderer);
    void replaceMeshes(Renderer& renderer, FrameMeshes meshes);
    FrameDescription describe(const RenderView& view) const;
    double samplesMotion(const RenderView& view) const;
    void move(double position, std::vector<SurfaceDraw>& draws) const;

    const Scene scene_;
    const Pace pace_;
    RenderInbox& inbox_;
    const Hooks hooks_;
    std::optional<FrameMeshes> shown_;
    std::vector<SurfaceDraw> draws_;  ///< of surfaces, then of objects
    MeshUploads meshes_;
    SampleUploads samples_;
    std::exception_ptr failure_;
    std::jthread thread_;  ///< last member: it uses all the others
};

/// By how much the fraction of a key interval grows that is to grow by `wanted` from `fraction` but stays in
/// [0,1]; 0 where the time that is wanted is more than an interval beyond.
double motionWithin(double fraction, double wanted);

/// The view that a scene describes, from the beginning of its camera's path.
RenderView sceneView(const Scene& scene);

/// How the scene's surfaces and objects are drawn: placement, colour and opacity for each of
/// `meshes.meshes()`. The mesh ids are left open.
std::vector<SurfaceDraw> surfaceDraws(const Scene& scene, const SceneMeshes& meshes);

/// The frame's description without its surfaces.
FrameDescription describeFrame(const Scene& scene, const RenderView& view);

}  // namespace isoglass
