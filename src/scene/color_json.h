#pragma once

#include "scene/json_node.h"
#include "scene/scene.h"

#include <nlohmann/json.hpp>

#include <filesystem>

namespace isoglass {

/// Reads an sRGB hex colour.
LinearColor readColor(const JsonNode& node);

/// Reads a surface's colour: one for all of it, or by a value at each point.
void readSurfaceColor(const JsonNode& node, const std::filesystem::path& baseFolder, Surface& surface);

/// The same as JSON.
nlohmann::ordered_json surfaceColorJson(const Surface& surface, const std::filesystem::path& baseFolder);

/// A path as a scene file in `baseFolder` writes it; as it is where that is empty.
std::string relativeSeriesPath(const std::filesystem::path& series, const std::filesystem::path& baseFolder);

}  // namespace isoglass
