#pragma once

#include "app/view/overlay.h"
#include "app/view/screenshots.h"
#include "basis/mailbox.h"
#include "gl/window.h"
#include "pipeline/render_loop.h"

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace isoglass {

/// What the window shows beside the scene, and what is to be done with its picture.
struct OutputOrder {
    OverlayText text;
    std::uint64_t screenshots = 0;  ///< how many were asked for since the beginning
    /// The picture to save is the first one after this request, or a later one, was answered with meshes that
    /// are as the scene wants them; 0: the first one.
    std::uint64_t screenshotRequest = 0;

    friend bool operator==(const OutputOrder&, const OutputOrder&) = default;
};

/// What the window shows, for its title.
struct ShownMoment {
    std::vector<double> axisTimes;  ///< one a volume, in its series' own units; empty before the first mesh
    std::string failure;            ///< why the newest meshes are missing; empty where they are not
    int substitute = 0;             ///< the coarsest level that stands for key frames that are not there yet
};

/// The render thread's side of the viewer: puts each drawn frame into the window, with the overlay over it,
/// and saves pictures.
class WindowOutput {
  public:
    /// `name` begins the names of pictures. All must outlive the render loop that has the hooks.
    WindowOutput(gl::Window& window, RenderInbox& inbox, Screenshots& screenshots, std::string name);

    /// For the render loop; its `ended` and `present` wake the window.
    RenderLoop::Hooks hooks();

    /// Any thread.
    void post(OutputOrder order) { orders_.post(std::move(order)); }
    /// The render loop has ended. Any thread.
    bool ended() const { return ended_; }
    /// The newest frame that was shown since the last call. Any thread.
    std::optional<ShownMoment> takeShown() { return shown_.tryTake(); }

  private:
    struct Target;

    std::unique_ptr<gl::CurrentContext> makeContext();
    bool present(const ShownFrame& shown, Renderer& renderer);
    void answer(const FrameMeshes& meshes, std::string failure);
    void saveIfDue(Renderer& renderer);

    gl::Window& window_;
    Screenshots& screenshots_;
    const std::string name_;
    const float scale_;
    Mailbox<OutputOrder> orders_;
    Mailbox<ShownMoment> shown_;
    std::atomic<bool> ended_{false};

    // The rest belongs to the render thread.
    Target* target_ = nullptr;  ///< owned by the render loop
    OutputOrder order_;
    std::uint64_t saved_ = 0;
    std::optional<std::uint64_t> answered_;  ///< the newest request whose meshes came, or failed to
    int substitute_ = 0;                     ///< of those meshes
    std::string failure_;
};

}  // namespace isoglass
