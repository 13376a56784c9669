#pragma once

#include "scene/json_node.h"
#include "scene/scene.h"

#include <nlohmann/json.hpp>

#include <vector>

namespace isoglass {

/// Reads a list of clip objects.
std::vector<ClipPlane> readClip(const JsonNode& list);

/// The same as JSON.
nlohmann::ordered_json clipJson(const std::vector<ClipPlane>& planes);

}  // namespace isoglass
