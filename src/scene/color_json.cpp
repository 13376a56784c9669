#include "scene/color_json.h"

#include "scene/color.h"
#include "scene/color_map.h"
#include "scene/scene_format.h"

#include <array>

namespace isoglass {

namespace {

using Word = std::string_view;

constexpr std::array kValues{Word("series"), Word("value"), Word("curvature"), Word("level")};

FieldColor readFieldColor(const JsonNode& node, const std::filesystem::path& baseFolder) {
    FieldColor color;
    const auto series = node.find("series");
    if (series && series->text().empty()) series->failExpected("the path of a series");
    const auto range = node.find("range");
    if (const auto map = node.find("map")) color.map = map->choice(colorMapNames());
    if (range) {
        range->numbers(2, [&](std::size_t i, double value) { (i == 0 ? color.low : color.high) = value; });
        if (color.low == color.high) range->failExpected("two different numbers");
    }
    const std::size_t by = node.require("by").choice(kValues);
    color.by = static_cast<FieldColor::By>(by);
    if (series && color.by != FieldColor::By::series)
        series->fail("\"series\" does not belong to a colour by " + inQuotes(kValues[by]), "remove it");
    if (color.by == FieldColor::By::series) {
        color.series = (baseFolder / node.require("series").text()).lexically_normal();
    }
    node.require("range");
    return color;
}

}  // namespace

LinearColor readColor(const JsonNode& node) {
    const auto color = node.value().is_string() ? linearFromHex(node.text()) : std::nullopt;
    if (!color) node.failExpected("an sRGB colour \"#rrggbb\"");
    return *color;
}

void readSurfaceColor(const JsonNode& node, const std::filesystem::path& baseFolder, Surface& surface) {
    if (node.value().is_object()) {
        surface.fieldColor = readFieldColor(node.object(), baseFolder);
    } else {
        surface.color = readColor(node);
    }
}

nlohmann::ordered_json surfaceColorJson(const Surface& surface, const std::filesystem::path& baseFolder) {
    if (!surface.fieldColor) return hexFromLinear(surface.color);
    const FieldColor& color = *surface.fieldColor;
    nlohmann::ordered_json json{{"by", kValues[static_cast<std::size_t>(color.by)]}};
    if (color.by == FieldColor::By::series) json["series"] = relativeSeriesPath(color.series, baseFolder);
    json["map"] = kColorMapTables.at(color.map).name;
    json["range"] = nlohmann::ordered_json::array({color.low, color.high});
    return json;
}

std::string relativeSeriesPath(const std::filesystem::path& series, const std::filesystem::path& baseFolder) {
    if (baseFolder.empty()) return series.string();
    return std::filesystem::absolute(series)
        .lexically_normal()
        .lexically_relative(std::filesystem::absolute(baseFolder).lexically_normal())
        .string();
}

}  // namespace isoglass
