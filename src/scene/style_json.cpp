#include "scene/style_json.h"

#include "scene/color.h"
#include "scene/color_json.h"
#include "scene/opacity_json.h"
#include "scene/scene_file.h"
#include "scene/scene_format.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace isoglass {

namespace {

using Word = std::string_view;

constexpr std::array kKinds{Word("layers"), Word("illustrative"), Word("volume")};
/// In the order of CutLight::Weight.
constexpr std::array kWeights{Word("step"), Word("ramp"), Word("smooth")};
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

/// Keys of one kind do not belong to another.
void checkKeys(const JsonNode& node, std::span<const Word> keys, Word kind) {
    for (const auto& [key, value] : node.value().items()) {
        if (std::ranges::find(keys, key) == keys.end())
            node.find(key)->fail(inQuotes(key) + " does not belong to the style " + inQuotes(kind),
                                 "its keys are: " + listWords(keys));
    }
}

LayerStyle readLayers(const JsonNode& node, const Scene& scene) {
    constexpr std::array kKeys{Word("kind"),      Word("volume"), Word("show"),
                               Word("count"),     Word("first"),  Word("colors"),
                               Word("opacities"), Word("step"),   Word("silhouette")};
    checkKeys(node, kKeys, kKinds[0]);
    if (scene.volumes.empty())
        node.fail("the style \"layers\" needs a volume", "add one, or remove \"style\"");
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
    return style;
}

IllustrativeStyle readIllustrative(const JsonNode& node) {
    constexpr std::array kKeys{Word("kind"),
                               Word("alpha"),
                               Word("beta"),
                               Word("depth_threshold"),
                               Word("normal_threshold"),
                               Word("hatch_angle"),
                               Word("hatch_size"),
                               Word("hatch_cross"),
                               Word("light"),
                               Word("paper"),
                               Word("front"),
                               Word("back")};
    checkKeys(node, kKeys, kKinds[1]);
    IllustrativeStyle style;
    const auto read = [&](Word key, float& value, const NumberRange& range) {
        if (const auto found = node.find(key)) value = static_cast<float>(found->number(range));
    };
    read("alpha", style.alpha, {.low = 0, .high = 1});
    style.beta = std::min(style.beta, style.alpha);
    read("beta", style.beta, {.low = 0, .high = shortestDouble(style.alpha)});
    read("depth_threshold", style.depthThreshold, {.low = 0, .high = 1e6, .openLow = true});
    read("normal_threshold", style.normalThreshold, {.low = -4, .high = 4});
    read("hatch_angle", style.hatchAngle, {.low = -360, .high = 360});
    read("hatch_size", style.hatchSize, {.low = 1, .high = 1024});
    read("hatch_cross", style.hatchCross, {.low = 0, .high = 1});
    if (const auto light = node.find("light")) {
        style.light = glm::vec3(light->vector());
        const float length = glm::length(style.light);
        if (!(length > 0) || !std::isfinite(length))
            light->fail("expected a direction, found a vector of length 0 or too large");
    }
    const auto readColor = [&](Word key, glm::vec3& color) {
        if (const auto found = node.find(key)) color = isoglass::readColor(*found);
    };
    readColor("paper", style.paper);
    readColor("front", style.front);
    readColor("back", style.back);
    return style;
}

/// Pairs of a value and what `store` makes of the second item, by increasing value.
template <typename Store>
void readPoints(const JsonNode& node, Store store) {
    if (node.size() == 0) node.failExpected("at least one pair [value, ...]");
    double last = 0;
    for (std::size_t i = 0; i < node.size(); ++i) {
        const JsonNode point = node.item(i);
        if (point.size() != 2) point.failExpected("a pair [value, ...]");
        const double value = point.item(0).number();
        if (i > 0 && !(value > last))
            point.item(0).failExpected("a larger value than that of the pair before");
        last = value;
        store(value, point.item(1));
    }
}

CutLight readCutLight(const JsonNode& node) {
    node.object();
    CutLight cut;
    cut.thickness = node.require("thickness").number({.low = 0, .openLow = true});
    if (const auto weight = node.find("weight"))
        cut.weight = static_cast<CutLight::Weight>(weight->choice(kWeights));
    return cut;
}

VolumeStyle readShaded(const JsonNode& node, const Scene& scene) {
    constexpr std::array kKeys{Word("kind"), Word("volume"), Word("colors"), Word("opacities"),
                               Word("unit"), Word("step"),   Word("lit"),    Word("cut")};
    checkKeys(node, kKeys, kKinds[2]);
    if (scene.volumes.empty())
        node.fail("the style \"volume\" needs a volume", "add one, or remove \"style\"");
    VolumeStyle style;
    if (const auto volume = node.find("volume")) style.volume = readVolume(*volume, scene);
    readPoints(node.require("colors"), [&](double value, const JsonNode& color) {
        style.colors.push_back({value, readColor(color)});
    });
    readPoints(node.require("opacities"), [&](double value, const JsonNode& opacity) {
        style.opacities.push_back({value, static_cast<float>(opacity.number({.low = 0, .high = 1}))});
    });
    if (const auto unit = node.find("unit")) style.unit = unit->number({.low = 0, .openLow = true});
    if (const auto step = node.find("step")) style.step = step->number({.low = 0.01, .high = 8});
    if (const auto lit = node.find("lit")) style.lit = lit->boolean();
    if (const auto cut = node.find("cut")) {
        if (!style.lit) cut->fail("\"cut\" lights what \"lit\": false leaves without light", "remove one");
        style.cut = readCutLight(*cut);
    }
    const std::string& shown = style.volume.empty() ? scene.volumes.front().name : style.volume;
    for (const Volume& volume : scene.volumes) {
        if (volume.surfaces.empty() && volume.name != shown)
            node.fail("the volume " + inQuotes(volume.name) + " shows nothing",
                      "give it surfaces, or remove it");
    }
    return style;
}

}  // namespace

bool asksForShadedVolume(const JsonNode& root) {
    const auto style = root.value().find("style");
    return style != root.value().end() && style->is_object() &&
           style->value("kind", nlohmann::json()) == kKinds[2];
}

void readStyle(const JsonNode& node, Scene& scene) {
    node.object();
    const JsonNode kind = node.require("kind");
    switch (kind.choice(kKinds)) {
        case 0:
            scene.layers = readLayers(node, scene);
            return;
        case 1:
            scene.illustrative = readIllustrative(node);
            return;
        default:
            scene.shaded = readShaded(node, scene);
    }
}

nlohmann::ordered_json styleJson(const IllustrativeStyle& style) {
    return {{"kind", kKinds[1]},
            {"alpha", shortestDouble(style.alpha)},
            {"beta", shortestDouble(style.beta)},
            {"depth_threshold", shortestDouble(style.depthThreshold)},
            {"normal_threshold", shortestDouble(style.normalThreshold)},
            {"hatch_angle", shortestDouble(style.hatchAngle)},
            {"hatch_size", shortestDouble(style.hatchSize)},
            {"hatch_cross", shortestDouble(style.hatchCross)},
            {"light",
             {shortestDouble(style.light.x), shortestDouble(style.light.y), shortestDouble(style.light.z)}},
            {"paper", hexFromLinear(style.paper)},
            {"front", hexFromLinear(style.front)},
            {"back", hexFromLinear(style.back)}};
}

nlohmann::ordered_json styleJson(const VolumeStyle& style) {
    nlohmann::ordered_json json{{"kind", kKinds[2]}};
    if (!style.volume.empty()) json["volume"] = style.volume;
    for (const auto& [value, color] : style.colors)
        json["colors"].push_back(nlohmann::ordered_json::array({value, hexFromLinear(color)}));
    for (const auto& [value, opacity] : style.opacities)
        json["opacities"].push_back(nlohmann::ordered_json::array({value, shortestDouble(opacity)}));
    if (style.unit) json["unit"] = *style.unit;
    json["step"] = style.step;
    json["lit"] = style.lit;
    if (style.cut) {
        json["cut"] = {{"thickness", style.cut->thickness},
                       {"weight", kWeights[static_cast<std::size_t>(style.cut->weight)]}};
    }
    return json;
}

std::string toJson(const IllustrativeStyle& style) {
    return styleJson(style).dump();
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
