#pragma once

#include "scene/json_node.h"
#include "scene/scene.h"

#include <span>
#include <string_view>

namespace isoglass {

/// The methods by the names that people write, "auto" first, in the order of the enumeration.
std::span<const std::string_view> transparencyMethodNames();
std::string_view transparencyMethodName(TransparencyMethod method);
/// `name` must be one of them.
TransparencyMethod transparencyMethodNamed(std::string_view name);

/// Reads the object `transparency` of a scene file.
Transparency readTransparency(const JsonNode& node);

}  // namespace isoglass
