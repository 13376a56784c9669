#include "app/view/style_controls.h"

#include "scene/color.h"
#include "scene/scene_file.h"

#include <gtest/gtest.h>

#include <set>

namespace isoglass {
namespace {

Scene illustrative() {
    Scene scene;
    scene.illustrative = IllustrativeStyle{.hatchSize = 6};
    return scene;
}

void typeAll(StyleControls& controls, std::u32string_view text) {
    for (const char32_t character : text) controls.type(character);
}

TEST(StyleControls, BeginWithTheScenesStyleAndSwitchItOff) {
    StyleControls controls(illustrative());
    EXPECT_EQ(controls.shown(), illustrative().illustrative);
    EXPECT_TRUE(controls.type(U'i'));
    EXPECT_FALSE(controls.shown());
    controls.type(U'i');
    EXPECT_EQ(controls.shown(), illustrative().illustrative);
}

TEST(StyleControls, AnySceneCanBeDrawnAsLines) {
    StyleControls controls((Scene()));
    EXPECT_FALSE(controls.shown());
    controls.type(U'i');
    EXPECT_EQ(controls.shown(), IllustrativeStyle());
}

TEST(StyleControls, LayersStayLayers) {
    Scene scene;
    scene.layers.emplace();
    StyleControls controls(scene);
    EXPECT_FALSE(controls.type(U'i'));
    EXPECT_FALSE(controls.shown());
}

TEST(StyleControls, OtherKeysAndThoseWithoutAStyleAreNotTaken) {
    StyleControls controls(illustrative());
    for (const char32_t other : {U'q', U's', U' ', U'+'}) EXPECT_FALSE(controls.type(other));
    controls.type(U'i');
    EXPECT_FALSE(controls.type(U'n'));
}

/// Going round once shows all of them; each grows and comes back.
TEST(StyleControls, EveryParameterCanBeChanged) {
    StyleControls controls(illustrative());
    std::set<std::string> seen;
    for (int i = 0; i < 13; ++i) {
        controls.type(U'n');
        const std::string notice = controls.notice();
        EXPECT_TRUE(
            seen.insert(notice.substr(0, notice.find(notice.starts_with("light") ? "  " : " "))).second)
            << notice;
        const auto before = controls.shown();
        typeAll(controls, U"-");
        EXPECT_NE(controls.shown(), before) << notice;
    }
    const auto changed = controls.shown();
    EXPECT_EQ(controls.notice().substr(0, 4), "back");
    controls.type(U'n');
    EXPECT_EQ(controls.notice().substr(0, 5), "alpha");
    controls.type(U'N');
    EXPECT_EQ(controls.notice().substr(0, 4), "back");
    EXPECT_EQ(controls.shown(), changed);
}

TEST(StyleControls, StepsAreExactAndStopAtTheEnds) {
    StyleControls controls(illustrative());
    typeAll(controls, U"n--");
    EXPECT_FLOAT_EQ(controls.shown()->alpha, 0.6f);
    typeAll(controls, U"+++++++++++++++++++");
    EXPECT_EQ(controls.shown()->alpha, 1);
    typeAll(controls, U"-------------------------");
    EXPECT_EQ(controls.shown()->alpha, 0);
    EXPECT_EQ(controls.shown()->beta, 0) << "at most alpha";
}

TEST(StyleControls, ALightAlwaysHasADirection) {
    Scene scene = illustrative();
    scene.illustrative->light = {0, 0, 0.1f};
    StyleControls controls(scene);
    typeAll(controls, U"nnnnnnnnnn");
    ASSERT_EQ(controls.notice().substr(0, 7), "light z");
    controls.type(U'-');
    EXPECT_EQ(controls.shown()->light, glm::vec3(0, 0, 0.1f));
}

TEST(StyleControls, AKeyNeverGoesTheOtherWay) {
    Scene scene = illustrative();
    scene.illustrative->light = {10, 20, 30};
    scene.illustrative->depthThreshold = 0.2f;
    StyleControls controls(scene);
    typeAll(controls, U"nnn-");
    EXPECT_EQ(controls.shown()->depthThreshold, 0.2f);
    typeAll(controls, U"nnnnn+");
    ASSERT_EQ(controls.notice().substr(0, 7), "light x");
    const glm::vec3 light = controls.shown()->light;
    EXPECT_GT(light.x / light.z, 10.0f / 30);
    EXPECT_FLOAT_EQ(light.y / light.z, 20.0f / 30);
}

/// Whatever beta is, it can be read again.
TEST(StyleControls, EveryBetaUpToAlphaIsThatOfASceneFile) {
    for (int steps = 0; steps <= 20; ++steps) {
        StyleControls controls(illustrative());
        controls.type(U'n');
        for (int i = 0; i < steps; ++i) controls.type(U'-');
        controls.type(U'n');
        for (int i = 0; i < 20; ++i) controls.type(U'+');
        const Scene scene = parseScene(
            R"({"version": 1, "meshes": [{"file": "a.ply"}], )" + controls.sceneText() + "}", "", "scene.json");
        EXPECT_EQ(scene.illustrative, controls.shown());
    }
}

/// What `p` prints can be put into a scene file.
TEST(StyleControls, TextIsThatOfASceneFile) {
    StyleControls controls(illustrative());
    typeAll(controls, U"n--nn++");
    const Scene scene = parseScene(
        R"({"version": 1, "meshes": [{"file": "a.ply"}], )" + controls.sceneText() + "}", "", "scene.json");
    EXPECT_EQ(scene.illustrative, controls.shown());
}

}  // namespace
}  // namespace isoglass
