#include "base/error.h"
#include "scene/color.h"
#include "scene/scene_file.h"

#include <gtest/gtest.h>

#include <cmath>

namespace isoglass {
namespace {

Scene parseWith(const std::string& style) {
    return parseScene(
        R"({"version": 1, "volumes": [{"name": "head", "series": "a.vdb", "surfaces": [{"iso": 2}]},
                                                   {"name": "other", "series": "b.vdb", "surfaces": [{"iso": 2}]}],
                         "style": )" +
            style + "}",
        "", "scene.json");
}

TEST(StyleJson, DefaultsAreThoseOfTheStyle) {
    EXPECT_EQ(parseWith(R"({"kind": "layers"})").layers, LayerStyle());
}

TEST(StyleJson, EveryKeyIsReadAndWritten) {
    const Scene composed =
        parseWith(R"({"kind": "layers", "volume": "other", "show": "composed", "count": 5, "first": 2,
        "colors": ["#ff0000", "#00ff00"], "opacities": [0.25, 0.5, 1], "step": 0.25})");
    LayerStyle style{.volume = "other", .show = LayerStyle::Show::composed, .count = 5};
    style.first = 2;
    style.colors = {*linearFromHex("#ff0000"), *linearFromHex("#00ff00")};
    style.opacities = {0.25f, 0.5f, 1.0f};
    style.step = 0.25;
    EXPECT_EQ(composed.layers, style);
    const Scene silhouettes = parseWith(R"({"kind": "layers", "show": "silhouettes", "silhouette": 0.125})");
    EXPECT_EQ(silhouettes.layers->show, LayerStyle::Show::silhouettes);
    EXPECT_EQ(silhouettes.layers->silhouette, 0.125);
    for (const Scene& scene : {composed, silhouettes, parseWith(R"({"kind": "layers", "show": "nth"})"),
                               parseWith(R"({"kind": "layers", "show": "blend"})")})
        EXPECT_EQ(parseScene(toJson(scene), "", "round trip"), scene) << toJson(scene);
}

TEST(StyleJson, EveryKeyOfAnIllustrationIsReadAndWritten) {
    EXPECT_EQ(parseWith(R"({"kind": "illustrative"})").illustrative, IllustrativeStyle());
    const Scene scene =
        parseWith(R"({"kind": "illustrative", "alpha": 0.5, "beta": 0.25, "depth_threshold": 2,
        "normal_threshold": 3.5, "hatch_angle": -45, "hatch_size": 6, "hatch_cross": 0.75, "light": [0, 1, 2],
        "paper": "#ffffff", "front": "#000080", "back": "#00ff00"})");
    const IllustrativeStyle style{.alpha = 0.5f,
                                  .beta = 0.25f,
                                  .depthThreshold = 2,
                                  .normalThreshold = 3.5f,
                                  .hatchAngle = -45,
                                  .hatchSize = 6,
                                  .hatchCross = 0.75f,
                                  .light = {0, 1, 2},
                                  .paper = *linearFromHex("#ffffff"),
                                  .front = *linearFromHex("#000080"),
                                  .back = *linearFromHex("#00ff00")};
    EXPECT_EQ(scene.illustrative, style);
    EXPECT_FALSE(scene.layers);
    EXPECT_EQ(parseScene(toJson(scene), "", "round trip"), scene) << toJson(scene);
    EXPECT_EQ(parseWith(toJson(style)).illustrative, style);
}

TEST(StyleJson, DefaultColoursAreThoseThatTheSchemaNames) {
    const IllustrativeStyle style;
    EXPECT_EQ(style.paper, *linearFromHex("#f5f4f0"));
    EXPECT_EQ(style.back, *linearFromHex("#c42020"));
}

TEST(StyleJson, EveryKeyOfAMediumIsReadAndWritten) {
    const Scene scene =
        parseWith(R"({"kind": "volume", "volume": "other", "colors": [[-1, "#ff0000"], [2.5, "#0000ff"]],
        "opacities": [[0, 0], [1, 0.25], [3, 1]], "unit": 2, "step": 0.25, "lit": false})");
    VolumeStyle style{.volume = "other",
                      .colors = {{-1, {1, 0, 0}}, {2.5, {0, 0, 1}}},
                      .opacities = {{0, 0}, {1, 0.25f}, {3, 1}}};
    style.unit = 2;
    style.step = 0.25;
    style.lit = false;
    EXPECT_EQ(scene.shaded, style);
    EXPECT_EQ(parseScene(toJson(scene), "", "round trip"), scene) << toJson(scene);
}

TEST(StyleJson, CutsAreLit) {
    const auto withCut = [](const std::string& cut) {
        return parseWith(R"({"kind": "volume", "colors": [[0, "#ff0000"]], "opacities": [[0, 1]], "cut": )" +
                         cut + "}");
    };
    using Weight = CutLight::Weight;
    EXPECT_EQ(withCut(R"({"thickness": 2})").shaded->cut, (CutLight{2, Weight::ramp}));
    for (const auto& [word, weight] : {std::pair("step", Weight::step), std::pair("ramp", Weight::ramp),
                                       std::pair("smooth", Weight::smooth)}) {
        const Scene scene = withCut(R"({"thickness": 0.5, "weight": ")" + std::string(word) + "\"}");
        EXPECT_EQ(scene.shaded->cut, (CutLight{0.5, weight}));
        EXPECT_EQ(parseScene(toJson(scene), "", "round trip"), scene) << toJson(scene);
    }
    for (const char* wrong : {"{}", R"({"thickness": 0})", R"({"thickness": 1, "weight": "hard"})", "1",
                              R"({"thickness": 1}, "lit": false)"})
        EXPECT_THROW(withCut(wrong), Error) << wrong;
}

TEST(StyleJson, ColoursAndOpacitiesOfAMediumAreNeededAndGrow) {
    EXPECT_THROW(parseWith(R"({"kind": "volume", "colors": [[0, "#ff0000"]]})"), Error);
    EXPECT_THROW(parseWith(R"({"kind": "volume", "opacities": [[0, 1]]})"), Error);
    EXPECT_THROW(parseWith(R"({"kind": "volume", "colors": [], "opacities": [[0, 1]]})"), Error);
    EXPECT_THROW(
        parseWith(R"({"kind": "volume", "colors": [[0, "#ff0000"]], "opacities": [[0, 1], [0, 1]]})"), Error);
    EXPECT_THROW(parseWith(R"({"kind": "volume", "colors": ["#ff0000"], "opacities": [[0, 1]]})"), Error);
}

/// A medium needs no surface, but a volume that shows nothing is a mistake.
TEST(StyleJson, OnlyTheVolumeOfAMediumMayHaveNoSurfaces) {
    const std::string one = R"({"version": 1, "volumes": [{"name": "a", "series": "a.vdb"}], "style":
        {"kind": "volume", "colors": [[0, "#ff0000"]], "opacities": [[0, 1]]}})";
    EXPECT_TRUE(parseScene(one, "", "scene.json").volumes[0].surfaces.empty());
    const std::string two =
        R"({"version": 1, "volumes": [{"name": "a", "series": "a.vdb"}, {"name": "b", "series":
        "b.vdb"}], "style": {"kind": "volume", "colors": [[0, "#ff0000"]], "opacities": [[0, 1]]}})";
    EXPECT_THROW(parseScene(two, "", "scene.json"), Error);
}

TEST(VolumeStyle, IsLinearBetweenItsPointsAndConstantBeyond) {
    const VolumeStyle style{.colors = {{0, {1, 0, 0}}, {2, {0, 1, 0}}},
                            .opacities = {{1, 0}, {2, 0.5f}, {4, 1}}};
    EXPECT_EQ(transferAt(style, -1), glm::vec4(1, 0, 0, 0));
    EXPECT_EQ(transferAt(style, 1.5), glm::vec4(0.25f, 0.75f, 0, 0.25f));
    EXPECT_EQ(transferAt(style, 3), glm::vec4(0, 1, 0, 0.75f));
    EXPECT_EQ(transferAt(style, 9), glm::vec4(0, 1, 0, 1));
}

/// 0 < beta < alpha < 1 in the paper (2).
TEST(StyleJson, BetaIsAtMostAlpha) {
    EXPECT_EQ(parseWith(R"({"kind": "illustrative", "alpha": 0.1})").illustrative->beta, 0.1f);
    EXPECT_THROW(parseWith(R"({"kind": "illustrative", "alpha": 0.1, "beta": 0.2})"), Error);
}

TEST(StyleJson, KeysOfAnotherKindAreRefused) {
    EXPECT_THROW(parseWith(R"({"kind": "illustrative", "count": 2})"), Error);
    EXPECT_THROW(parseWith(R"({"kind": "layers", "alpha": 0.5})"), Error);
    EXPECT_THROW(parseWith(R"({"kind": "illustrative", "light": [0, 0, 0]})"), Error);
}

/// A window of depth n/z, n = 1, over a plane whose distance grows by 3 pixel sizes a pixel at z = 30:
/// Sobel's sum (weights 1, 2, 1 over two pixels) gives 8 times the derivative.
TEST(IllustrativeStyle, ThePapersThresholdHasItsMeaning) {
    constexpr int kRows = 720;
    constexpr double kFov = 30, kZ = 30;
    const double pixel = kZ * 2 * std::tan(kFov * M_PI / 360) / kRows;
    const double sobel = 8 * (1 / kZ - 1 / (kZ + 1e-6 * 3 * pixel)) / 1e-6;
    EXPECT_NEAR(depthThresholdFromPaper(sobel, kZ, kRows, kFov), 3, 1e-6);
    // The default: a near plane a thirtieth of the distance away, 720 rows under 30 degrees.
    EXPECT_NEAR(depthThresholdFromPaper(0.001, 30, kRows, kFov), IllustrativeStyle().depthThreshold, 0.05);
}

TEST(LayerStyle, LastColourAndOpacityStay) {
    LayerStyle style{.colors = {{1, 0, 0}, {0, 1, 0}}, .opacities = {0.1f, 0.2f}};
    EXPECT_EQ(layerColor(style, 0, {}), glm::vec3(1, 0, 0));
    EXPECT_EQ(layerColor(style, 7, {}), glm::vec3(0, 1, 0));
    EXPECT_EQ(layerOpacity(style, 0), 0.1f);
    EXPECT_EQ(layerOpacity(style, 7), 0.2f);
    style = {};
    EXPECT_EQ(layerColor(style, 2, {0.1f, 0.2f, 0.3f}), glm::vec3(0.1f, 0.2f, 0.3f));
}

/// Fog hides what is far away (section 4 of the paper).
TEST(LayerStyle, HiddenSilhouettesAreLighter) {
    const LayerStyle style{.show = LayerStyle::Show::silhouettes, .count = 4};
    EXPECT_EQ(layerColor(style, 0, {1, 1, 1}), glm::vec3(0));
    for (int layer = 1; layer < 4; ++layer)
        EXPECT_GT(layerColor(style, layer, {}).x, layerColor(style, layer - 1, {}).x);
    EXPECT_LT(layerColor(style, 3, {}).x, 1);
}

}  // namespace
}  // namespace isoglass
