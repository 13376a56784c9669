#pragma once

#include "scene/scene.h"

#include <nlohmann/json.hpp>

namespace isoglass {

/// The fits of the scene's cosine opacities and how far they are from the shell, one entry a surface.
nlohmann::ordered_json cosineFitsJson(const Scene& scene);
/// The same for people, on standard output; nothing where no surface has one.
void printCosineFits(const Scene& scene);

}  // namespace isoglass
