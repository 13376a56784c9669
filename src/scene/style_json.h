#pragma once

#include "scene/json_node.h"
#include "scene/scene.h"

#include <nlohmann/json.hpp>

namespace isoglass {

/// Whether the style of a scene file is "volume", whatever else is wrong with it.
bool asksForShadedVolume(const JsonNode& root);

/// Reads the object `style` of a scene file; the scene's volumes must be there.
void readStyle(const JsonNode& node, Scene& scene);

/// The same as JSON.
nlohmann::ordered_json styleJson(const LayerStyle& style);
nlohmann::ordered_json styleJson(const IllustrativeStyle& style);
nlohmann::ordered_json styleJson(const VolumeStyle& style);

}  // namespace isoglass
