#include "scene/color.h"
#include "scene/scene_file.h"

#include <gtest/gtest.h>

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
