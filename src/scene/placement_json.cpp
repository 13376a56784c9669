#include "scene/placement_json.h"

#include <glm/geometric.hpp>

#include <cmath>

namespace isoglass {

Placement readPlacement(const JsonNode& node) {
    node.object();
    Placement place;
    if (const auto translate = node.find("translate")) place.translate = translate->vector();
    if (const auto rotate = node.find("rotate")) {
        rotate->numbers(4, [&](std::size_t i, double value) { place.rotate[static_cast<int>(i)] = value; });
        const double length = glm::length(glm::dvec3(place.rotate));
        if (!(length > 0) || !std::isfinite(length))
            rotate->fail("expected an axis that is not zero", "[x, y, z, angle]");
    }
    if (const auto scale = node.find("scale")) {
        place.scale = scale->vector();
        for (int i = 0; i < 3; ++i) {
            if (place.scale[i] == 0)
                scale->item(static_cast<std::size_t>(i)).failExpected("a number other than 0");
        }
    }
    return place;
}

nlohmann::ordered_json placementJson(const Placement& place) {
    using Json = nlohmann::ordered_json;
    const auto& [translate, rotate, scale] = place;
    return {{"translate", Json::array({translate.x, translate.y, translate.z})},
            {"rotate", Json::array({rotate.x, rotate.y, rotate.z, rotate.w})},
            {"scale", Json::array({scale.x, scale.y, scale.z})}};
}

}  // namespace isoglass
