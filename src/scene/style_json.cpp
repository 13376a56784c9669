#include "scene/style_json.h"

#include "scene/color.h"
#include "scene/color_json.h"
#include "scene/opacity_json.h"
#include "scene/scene_format.h"

#include <algorithm>
#include <array>

namespace isoglass {

namespace {

using Word = std::string_view;

constexpr std::array kKinds{Word("layers"), Word("illustrative"), Word("volume")};
/// In the order of LayerStyle::Show.
constexpr std::array kShows{Word("nth"), Word("blend"), Word("composed"), Word("silhouettes")};

std::string readVolume(const JsonNode& node, const Scene& scene) {
    const auto count = std::ranges::count(scene.volumes, node.text(), &Volume::name);
    if (count == 1) return node.text();
    node.fail(count == 0 ? "no volume has that name" : "several volumes have that name",
              "name one volume of the scene");
}

/// Hands every item of a list to `store`; one for each layer at most.
template <typename Store>
void readList(const JsonNode& node, Store store) {
    if (node.size() == 0 || node.size() > kMostStyleLayers)
        node.failExpected("1 to " + std::to_string(kMostStyleLayers) + " values");
    for (std::size_t i = 0; i < node.size(); ++i) store(node.item(i));
}

}  // namespace

void readStyle(const JsonNode& node, Scene& scene) {
    node.object();
    const JsonNode kind = node.require("kind");
    if (kind.choice(kKinds) != 0)
        kind.failUnavailable("the style " + inQuotes(kind.text()), "choose \"layers\", or remove \"style\"");
    LayerStyle style;
    if (const auto volume = node.find("volume")) style.volume = readVolume(*volume, scene);
    if (const auto show = node.find("show")) style.show = static_cast<LayerStyle::Show>(show->choice(kShows));
    if (const auto count = node.find("count")) style.count = count->integer(1, kMostStyleLayers);
    if (const auto first = node.find("first")) {
        if (style.show == LayerStyle::Show::nth)
            first->fail("\"first\" does not belong to one layer alone", "remove it");
        style.first = first->integer(1, style.count);
    }
    if (const auto colors = node.find("colors")) {
        readList(*colors, [&](const JsonNode& item) { style.colors.push_back(readColor(item)); });
    }
    if (const auto opacities = node.find("opacities")) {
        if (style.show != LayerStyle::Show::composed)
            opacities->fail("\"opacities\" belong to what is \"composed\"", "show that, or remove them");
        readList(*opacities, [&](const JsonNode& item) {
            style.opacities.push_back(static_cast<float>(item.number({.low = 0, .high = 1})));
        });
    }
    if (const auto step = node.find("step")) style.step = step->number({.low = 0.01, .high = 8});
    if (const auto silhouette = node.find("silhouette")) {
        if (style.show != LayerStyle::Show::silhouettes)
            silhouette->fail("\"silhouette\" belongs to \"silhouettes\"", "show those, or remove it");
        style.silhouette = silhouette->number({.low = 0, .high = 1, .openLow = true});
    }
    scene.layers = std::move(style);
}

nlohmann::ordered_json styleJson(const LayerStyle& style) {
    nlohmann::ordered_json json{{"kind", kKinds[0]},
                                {"show", kShows[static_cast<std::size_t>(style.show)]},
                                {"count", style.count},
                                {"step", style.step}};
    if (style.show != LayerStyle::Show::nth) json["first"] = style.first;
    if (!style.volume.empty()) json["volume"] = style.volume;
    for (const LinearColor& color : style.colors) json["colors"].push_back(hexFromLinear(color));
    if (style.show == LayerStyle::Show::composed) {
        for (const float opacity : style.opacities) json["opacities"].push_back(shortestDouble(opacity));
    }
    if (style.show == LayerStyle::Show::silhouettes) json["silhouette"] = style.silhouette;
    return json;
}

}  // namespace isoglass
