#pragma once

#include "scene/json_node.h"
#include "scene/scene.h"

#include <nlohmann/json.hpp>

namespace isoglass {

Placement readPlacement(const JsonNode& node);

/// The same as JSON.
nlohmann::ordered_json placementJson(const Placement& place);

}  // namespace isoglass
