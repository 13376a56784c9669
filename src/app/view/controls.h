#pragma once

#include "app/view/camera_control.h"
#include "app/view/playhead.h"
#include "app/view/style_controls.h"
#include "gl/window.h"
#include "scene/scene.h"

#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

namespace isoglass {

/// The keys and what they do, a line each; for the help in the window and on the command line.
std::string_view viewerHelp();

/// What an event asks of others than the controls.
struct ViewerWish {
    bool quit = false;
    bool screenshot = false;
    bool printStyle = false;
    std::vector<std::filesystem::path> open = {};  ///< files that were dropped
};

/// The user's hold on one scene: what the events of the window do to camera, playhead and the rest. Knows no
/// window, clock or thread: both come as arguments.
class ViewerControls {
  public:
    /// Begins paused at the scene's first moment, seen by the scene's camera. `keyPositions` are those of
    /// the key frames, sorted.
    ViewerControls(const Scene& scene, std::vector<double> keyPositions);

    /// `windowSize` is that of the coordinates in the event, `now` is in seconds.
    ViewerWish handle(const gl::WindowEvent& event, glm::dvec2 windowSize, double now);

    /// The scene's own until the user moves it: it then stays where the user put it.
    CameraPose camera(double now) const;
    const Playhead& playhead() const { return playhead_; }
    const StyleControls& style() const { return style_; }
    bool wireframe() const { return wireframe_; }
    bool help() const { return help_; }

  private:
    struct Drag {
        gl::MouseButton button;
        bool pans;
        glm::dvec2 from;   ///< where the cursor was
        CameraPose begun;  ///< and the camera
    };

    void press(const gl::KeyPressed& key, double now);
    ViewerWish type(char32_t character, double now);
    void changeButton(const gl::ButtonChanged& change, double now);
    void drag(glm::dvec2 cursor, double windowHeight);
    void zoom(const gl::Scrolled& scroll, glm::dvec2 windowSize, double now);

    Camera sceneCamera_;
    Lens lens_;
    std::vector<double> keyPositions_;
    Playhead playhead_;
    StyleControls style_;
    std::optional<CameraPose> moved_;
    std::optional<Drag> drag_;
    bool wireframe_ = false;
    bool help_ = false;
};

}  // namespace isoglass
