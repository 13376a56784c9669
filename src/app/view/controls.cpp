#include "app/view/controls.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace isoglass {

namespace {

/// One step of the wheel brings the eye nearer by a sixth.
constexpr double kZoomStep = 5.0 / 6.0;
/// How much nearer or farther than the scene's own camera one can go.
constexpr double kZoomRange = 1e4;

template <typename... Handlers>
struct Overloaded : Handlers... {
    using Handlers::operator()...;
};

}  // namespace

std::string_view viewerHelp() {
    return "left drag          turn\n"
           "right drag         move (also middle drag, shift + left drag)\n"
           "wheel              zoom towards the cursor\n"
           "space              play or pause\n"
           "b                  play backwards or pause\n"
           "left, right        the key frame before or after\n"
           "shift + left/right the displayed frame before or after\n"
           "Home               the scene's own camera again\n"
           "i                  line drawing that shows what is hidden, on or off\n"
           "n, N               its next or previous parameter; + and - change it\n"
           "p                  print them as a scene file has them\n"
           "w                  wireframe on or off\n"
           "s                  save a picture (PNG) in the working folder\n"
           "?                  this help on or off\n"
           "q, Esc             quit\n"
           "drop a file        open a scene (.json), a series (.vdb) or a mesh\n";
}

ViewerControls::ViewerControls(const Scene& scene, std::vector<double> keyPositions)
    : sceneCamera_(scene.camera),
      lens_{.up = scene.camera.up, .fovDegrees = scene.camera.fovDegrees},
      keyPositions_(std::move(keyPositions)),
      playhead_(scene.time),
      style_(scene) {}

CameraPose ViewerControls::camera(double now) const {
    return moved_ ? *moved_ : sceneCamera_.poseAt(playhead_.playbackSeconds(now));
}

ViewerWish ViewerControls::handle(const gl::WindowEvent& event, glm::dvec2 windowSize, double now) {
    ViewerWish wish;
    const Overloaded act{
        [&](const gl::KeyPressed& key) {
            if (key.key == gl::Key::escape) wish.quit = true;
            press(key, now);
        },
        [&](const gl::CharacterTyped& typed) { wish = type(typed.character, now); },
        [&](const gl::ButtonChanged& change) { changeButton(change, now); },
        [&](const gl::CursorMoved& moved) { drag(moved.cursor, windowSize.y); },
        [&](const gl::Scrolled& scroll) { zoom(scroll, windowSize, now); },
        [&](const gl::PictureNeeded&) {},
        [&](const gl::FilesDropped& dropped) { wish.open = dropped.files; },
        [&](const gl::CloseRequested&) { wish.quit = true; },
    };
    std::visit(act, event);
    return wish;
}

void ViewerControls::press(const gl::KeyPressed& key, double now) {
    if (key.key == gl::Key::home) moved_.reset();
    if (key.key != gl::Key::left && key.key != gl::Key::right) return;
    const bool forwards = key.key == gl::Key::right;
    playhead_.moveTo(key.shift ? playhead_.framesOn(now, forwards ? 1 : -1)
                               : nextKeyPosition(keyPositions_, playhead_.position(now), forwards),
                     forwards);
}

ViewerWish ViewerControls::type(char32_t character, double now) {
    if (style_.type(character)) return {};
    switch (character) {
        case U' ':
            playhead_.playing() ? playhead_.pause(now) : playhead_.play(now);
            return {};
        case U'b': {
            const bool running = playhead_.playing() && !playhead_.forwards();
            running ? playhead_.pause(now) : playhead_.play(now, false);
            return {};
        }
        case U'w':
            wireframe_ = !wireframe_;
            return {};
        case U'?':
            help_ = !help_;
            return {};
        case U's':
            return {.screenshot = true};
        case U'p':
            return {.printStyle = style_.shown().has_value()};
        case U'q':
            return {.quit = true};
        default:
            return {};
    }
}

void ViewerControls::changeButton(const gl::ButtonChanged& change, double now) {
    if (change.down && !drag_) {
        const bool pans = change.button != gl::MouseButton::left || change.shift;
        drag_ = {change.button, pans, change.cursor, camera(now)};
    } else if (!change.down && drag_ && drag_->button == change.button) {
        drag_.reset();
    }
}

/// From where the drag began, so that going back gives exactly the camera of then.
void ViewerControls::drag(glm::dvec2 cursor, double windowHeight) {
    if (!drag_ || !(windowHeight > 0)) return;
    const glm::dvec2 way = (cursor - drag_->from) / windowHeight;
    // A click does not take the camera off its path.
    if (way == glm::dvec2(0) && !moved_) return;
    moved_ = drag_->pans ? panned(drag_->begun, lens_, way) : orbited(drag_->begun, lens_, way);
}

void ViewerControls::zoom(const gl::Scrolled& scroll, glm::dvec2 windowSize, double now) {
    if (!(windowSize.y > 0)) return;
    const CameraPose pose = camera(now);
    const CameraPose home = sceneCamera_.poseAt(playhead_.playbackSeconds(now));
    const double relative = glm::distance(pose.eye, pose.target) / glm::distance(home.eye, home.target);
    const double wanted =
        std::clamp(relative * std::pow(kZoomStep, scroll.steps), 1 / kZoomRange, kZoomRange);
    moved_ = zoomed(pose, lens_, (scroll.cursor - windowSize / 2.0) / windowSize.y, wanted / relative);
    // What is being dragged goes on from here.
    if (drag_) drag_ = {drag_->button, drag_->pans, scroll.cursor, *moved_};
}

}  // namespace isoglass
