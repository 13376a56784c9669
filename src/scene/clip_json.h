#pragma once

#include "scene/json_node.h"
#include "scene/scene.h"

#include <nlohmann/json.hpp>

#include <vector>

namespace isoglass {

/// Reads a list of clip objects.
void readClip(const JsonNode& list, std::vector<ClipPlane>& planes, std::vector<ClipSolid>& solids);

/// Throws where solids would have to clip what is drawn as a mesh, or where planes or solids are too many for
/// a volume that rays go through.
void checkClip(const JsonNode& root, const Scene& scene);

/// The same as JSON: first the planes, then the solids.
nlohmann::ordered_json clipJson(const std::vector<ClipPlane>& planes, const std::vector<ClipSolid>& solids);

}  // namespace isoglass
