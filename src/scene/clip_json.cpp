#include "scene/clip_json.h"

#include <glm/geometric.hpp>

#include <cmath>

namespace isoglass {

namespace {

ClipPlane readPlane(const JsonNode& node) {
    node.object();
    for (const char* key : {"mesh", "keep", "method"}) {
        if (const auto found = node.find(key)) found->failUnavailable("clipping by a mesh", "use a plane");
    }
    ClipPlane clip;
    if (const auto cap = node.find("cap")) clip.cap = cap->boolean();
    const JsonNode plane = node.require("plane");
    plane.numbers(4, [&](std::size_t i, double value) { clip.plane[static_cast<int>(i)] = value; });
    const double length = glm::length(glm::dvec3(clip.plane));
    if (!(length > 0) || !std::isfinite(length)) {
        plane.fail("expected a normal that is not zero",
                   "[a, b, c, d] keeps what has a x + b y + c z + d >= 0");
    }
    return clip;
}

}  // namespace

std::vector<ClipPlane> readClip(const JsonNode& list) {
    std::vector<ClipPlane> planes;
    for (std::size_t i = 0; i < list.size(); ++i) planes.push_back(readPlane(list.item(i)));
    return planes;
}

nlohmann::ordered_json clipJson(const std::vector<ClipPlane>& planes) {
    auto json = nlohmann::ordered_json::array();
    for (const ClipPlane& each : planes) {
        const glm::dvec4& p = each.plane;
        json.push_back({{"plane", nlohmann::ordered_json::array({p.x, p.y, p.z, p.w})}, {"cap", each.cap}});
    }
    return json;
}

}  // namespace isoglass
