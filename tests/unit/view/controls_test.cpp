#include "app/view/controls.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace isoglass {
namespace {

using gl::ButtonChanged;
using gl::CharacterTyped;
using gl::CursorMoved;
using gl::Key;
using gl::KeyPressed;
using gl::MouseButton;
using gl::Scrolled;

constexpr glm::dvec2 kWindow(400, 200);

class ControlsTest : public testing::Test {
  protected:
    Scene scene_ = makeScene();
    ViewerControls controls_{scene_, {0, 0.5, 1}};
    double now_ = 0;

    static Scene makeScene() {
        Scene scene;
        scene.time = {.from = 0.0, .to = 2.0, .duration = 4, .fps = 25};
        return scene;
    }

    ViewerWish send(const gl::WindowEvent& event) { return controls_.handle(event, kWindow, now_); }
    void press(MouseButton button, glm::dvec2 at, bool shift = false) {
        send(ButtonChanged{button, true, shift, at});
    }
    void release(MouseButton button) { send(ButtonChanged{button, false, false, {}}); }
    CameraPose camera() const { return controls_.camera(now_); }
    double position() const { return controls_.playhead().position(now_); }
};

TEST_F(ControlsTest, LeftDragTurnsAndComesBackExactly) {
    const CameraPose home = camera();
    press(MouseButton::left, {100, 100});
    send(CursorMoved{{137, 88}});
    EXPECT_NE(camera(), home);
    EXPECT_EQ(camera().target, home.target);
    EXPECT_EQ(camera(), orbited(home, {}, {37.0 / 200, -12.0 / 200}));
    send(CursorMoved{{100, 100}});
    EXPECT_EQ(camera(), home);
}

TEST_F(ControlsTest, RightMiddleAndShiftedDragsPan) {
    const CameraPose home = camera();
    for (const auto& [button, shift] :
         {std::pair(MouseButton::right, false), {MouseButton::middle, false}, {MouseButton::left, true}}) {
        press(button, {0, 0}, shift);
        send(CursorMoved{{20, 10}});
        EXPECT_EQ(camera(), panned(home, {}, {0.1, 0.05}));
        release(button);
        send(KeyPressed{Key::home});
        EXPECT_EQ(camera(), home);
    }
}

TEST_F(ControlsTest, NothingMovesWithoutAButton) {
    const CameraPose home = camera();
    send(CursorMoved{{20, 10}});
    press(MouseButton::left, {0, 0});
    release(MouseButton::left);
    send(CursorMoved{{50, 50}});
    EXPECT_EQ(camera(), home);
}

TEST_F(ControlsTest, ASecondButtonDoesNotTakeTheDragAway) {
    press(MouseButton::left, {0, 0});
    press(MouseButton::right, {0, 0});
    release(MouseButton::right);
    send(CursorMoved{{20, 10}});
    EXPECT_EQ(camera().target, scene_.camera.pose.target) << "it still turns";
}

TEST_F(ControlsTest, WheelZoomsTowardsTheCursorWithinItsRange) {
    const CameraPose home = camera();
    send(Scrolled{1, {300, 50}});
    const CameraPose nearer = zoomed(home, {}, {0.5, -0.25}, 5.0 / 6);
    EXPECT_NEAR(glm::distance(camera().eye, nearer.eye), 0, 1e-13);
    EXPECT_NEAR(glm::distance(camera().target, nearer.target), 0, 1e-13);
    const double begin = glm::distance(home.eye, home.target);
    send(Scrolled{1e6, {200, 100}});
    EXPECT_NEAR(glm::distance(camera().eye, camera().target), begin * 1e-4, begin * 1e-12);
    send(Scrolled{-1e6, {200, 100}});
    EXPECT_NEAR(glm::distance(camera().eye, camera().target), begin * 1e4, begin * 1e-4);
}

TEST_F(ControlsTest, HomeFollowsTheScenesPathAgain) {
    scene_.camera.path = {{0, {.eye = {3, 0, 0}, .target = {0, 0, 0}}},
                          {4, {.eye = {0, 3, 0}, .target = {0, 0, 0}}}};
    controls_ = ViewerControls(scene_, {0, 0.5, 1});
    send(KeyPressed{Key::right});
    EXPECT_EQ(camera(), scene_.camera.poseAt(2));
    press(MouseButton::left, {0, 0});
    send(CursorMoved{{20, 10}});
    const CameraPose moved = camera();
    send(KeyPressed{Key::right});
    EXPECT_EQ(camera(), moved) << "stays where the user put it";
    send(KeyPressed{Key::home});
    EXPECT_EQ(camera(), scene_.camera.poseAt(4));
}

TEST_F(ControlsTest, AClickLeavesTheCameraOnItsPath) {
    scene_.camera.path = {{0, {.eye = {3, 0, 0}, .target = {0, 0, 0}}},
                          {4, {.eye = {0, 3, 0}, .target = {0, 0, 0}}}};
    controls_ = ViewerControls(scene_, {0, 0.5, 1});
    press(MouseButton::left, {10, 10});
    send(CursorMoved{{10, 10}});
    release(MouseButton::left);
    send(KeyPressed{Key::right});
    EXPECT_EQ(camera(), scene_.camera.poseAt(2));
}

TEST_F(ControlsTest, ArrowsStepKeyFramesAndDisplayedFrames) {
    send(KeyPressed{Key::right});
    EXPECT_EQ(position(), 0.5);
    send(KeyPressed{Key::right, true});
    EXPECT_EQ(position(), 0.51);
    send(KeyPressed{Key::left});
    EXPECT_EQ(position(), 0.5);
    send(KeyPressed{Key::left, true});
    EXPECT_EQ(position(), 0.49);
}

TEST_F(ControlsTest, SpacePlaysAndPausesAndASteppingPauses) {
    send(CharacterTyped{U' '});
    EXPECT_TRUE(controls_.playhead().playing());
    now_ = 1.01;
    EXPECT_EQ(position(), 0.25);
    send(CharacterTyped{U' '});
    now_ = 7;
    EXPECT_EQ(position(), 0.25);
    send(CharacterTyped{U' '});
    send(KeyPressed{Key::right});
    EXPECT_FALSE(controls_.playhead().playing());
    EXPECT_EQ(position(), 0.5);
}

TEST_F(ControlsTest, BPlaysBackwardsAndPauses) {
    send(CharacterTyped{U' '});
    now_ = 1.01;
    send(CharacterTyped{U'b'});
    EXPECT_TRUE(controls_.playhead().playing());
    EXPECT_FALSE(controls_.playhead().forwards());
    now_ = 1.51;
    const double there = position();
    EXPECT_LT(there, 0.25);
    send(CharacterTyped{U'b'});
    EXPECT_FALSE(controls_.playhead().playing());
    EXPECT_EQ(position(), there);
}

TEST_F(ControlsTest, LettersSwitchAndAsk) {
    send(CharacterTyped{U'w'});
    EXPECT_TRUE(controls_.wireframe());
    send(CharacterTyped{U'w'});
    EXPECT_FALSE(controls_.wireframe());
    send(CharacterTyped{U'?'});
    EXPECT_TRUE(controls_.help());
    EXPECT_TRUE(send(CharacterTyped{U's'}).screenshot);
    EXPECT_TRUE(send(CharacterTyped{U'q'}).quit);
    EXPECT_TRUE(send(KeyPressed{Key::escape}).quit);
    EXPECT_TRUE(send(gl::CloseRequested{}).quit);
    const ViewerWish nothing = send(CharacterTyped{U'x'});
    EXPECT_FALSE(nothing.quit || nothing.screenshot || !nothing.open.empty());
}

TEST_F(ControlsTest, DroppedFilesAreToBeOpened) {
    EXPECT_EQ(send(gl::FilesDropped{{"a.vdb"}}).open, std::vector<std::filesystem::path>{"a.vdb"});
}

TEST(ViewerHelp, NamesEveryKey) {
    for (const char* key : {"space", "left", "Home", "w ", "s ", "?", "q,", "Esc", "wheel", "drop"}) {
        EXPECT_NE(viewerHelp().find(key), std::string_view::npos) << key;
    }
}

}  // namespace
}  // namespace isoglass
