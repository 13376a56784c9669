#include "scene/opacity_json.h"

#include "scene/scene_format.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <initializer_list>

namespace isoglass {

namespace {

using Word = std::string_view;

constexpr std::array kModels{Word("constant"), Word("slab"), Word("cosine"), Word("iso-spectrum")};
constexpr NumberRange kShare{.low = 0, .high = 1};
/// What single precision holds, with room for products.
constexpr NumberRange kPositive{.low = 1e-12, .high = 1e12};
constexpr NumberRange kPartOfRadius{.low = 0, .high = 1, .openLow = true, .openHigh = true};

float readFloat(const JsonNode& node, const NumberRange& range) {
    return static_cast<float>(node.number(range));
}

/// Every key of a model is looked at, so one that belongs to another model is an error and not ignored.
void refuseOthers(const JsonNode& node, std::size_t model, std::initializer_list<Word> own) {
    for (const Word key : sceneKeys("/volumes/*/surfaces/*/opacity")) {
        const auto found = node.find(key);
        if (!found || key == "model" || std::find(own.begin(), own.end(), key) != own.end()) continue;
        found->fail(inQuotes(key) + " does not belong to the model " + inQuotes(kModels[model]), "remove it");
    }
}

ShellOpacity readSlab(const JsonNode& node) {
    refuseOthers(node, 1, {"extinction", "thickness", "iso_width", "max_thickness"});
    ShellOpacity shell{.model = ShellOpacity::Model::slab};
    shell.extinction = readFloat(node.require("extinction"), kPositive);
    const auto thickness = node.find("thickness");
    const auto width = node.find("iso_width");
    const auto most = node.find("max_thickness");
    if (thickness && (width || most)) {
        (width ? width : most)
            ->fail("a given thickness leaves nothing to the gradient",
                   "keep \"thickness\", or \"iso_width\" with \"max_thickness\"");
    }
    if (thickness) {
        shell.thickness = readFloat(*thickness, kPositive);
        return shell;
    }
    shell.isoWidth = readFloat(node.require("iso_width"), kPositive);
    shell.maxThickness = readFloat(node.require("max_thickness"), kPositive);
    return shell;
}

ShellOpacity readSphere(const JsonNode& node, ShellOpacity::Model model) {
    const bool cosine = model == ShellOpacity::Model::cosine;
    if (cosine) {
        refuseOthers(node, 2, {"extinction", "thickness", "power"});
    } else {
        refuseOthers(node, 3, {"extinction", "thickness"});
    }
    ShellOpacity shell{.model = model};
    shell.extinction = readFloat(node.require("extinction"), kPositive);
    shell.thickness = readFloat(node.require("thickness"), kPartOfRadius);
    if (const auto power = node.find("power")) shell.power = readFloat(*power, {.low = 0.01, .high = 100});
    return shell;
}

}  // namespace

void readOpacity(const JsonNode& node, Surface& surface) {
    if (!node.value().is_object()) {
        if (!node.value().is_number()) node.failExpected("a number from 0 to 1, or a model");
        surface.opacity = readFloat(node, kShare);
        return;
    }
    const std::size_t model = node.object().require("model").choice(kModels);
    if (model == 0) {
        refuseOthers(node, model, {"opacity"});
        surface.opacity = readFloat(node.require("opacity"), kShare);
    } else if (model == 1) {
        surface.shell = readSlab(node);
    } else {
        surface.shell =
            readSphere(node, model == 2 ? ShellOpacity::Model::cosine : ShellOpacity::Model::isoSpectrum);
    }
}

nlohmann::ordered_json opacityJson(const Surface& surface) {
    if (!surface.shell) return shortestDouble(surface.opacity);
    const ShellOpacity& shell = *surface.shell;
    nlohmann::ordered_json json{{"model", kModels[static_cast<std::size_t>(shell.model) + 1]},
                                {"extinction", shortestDouble(shell.extinction)}};
    if (shell.thickness > 0) {
        json["thickness"] = shortestDouble(shell.thickness);
    } else {
        json["iso_width"] = shortestDouble(shell.isoWidth);
        json["max_thickness"] = shortestDouble(shell.maxThickness);
    }
    if (shell.power) json["power"] = shortestDouble(*shell.power);
    return json;
}

double shortestDouble(float value) {
    std::array<char, 32> text;
    const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
    double result = 0;
    std::from_chars(text.data(), end, result);
    return result;
}

}  // namespace isoglass
