#pragma once

#include "scene/json_node.h"
#include "scene/scene.h"

#include <nlohmann/json.hpp>

namespace isoglass {

/// Reads a surface's opacity: a number, or a model with the numbers that belong to it and no others.
void readOpacity(const JsonNode& node, Surface& surface);

/// The same as JSON.
nlohmann::ordered_json opacityJson(const Surface& surface);

/// The double with the fewest digits that is `value` when rounded to single precision: 0.3, not
/// 0.30000001192092896.
double shortestDouble(float value);

}  // namespace isoglass
