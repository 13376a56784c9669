#pragma once

#include "scene/scene.h"

#include <filesystem>
#include <string>
#include <string_view>

namespace isoglass {

/// Reads a scene file (JSON, version 1; `data/scene.schema.json` is the reference). Paths in it are
/// relative to its folder. Throws Error: with line and column for a syntax error, else with the JSON
/// pointer of the value that is wrong, what was expected there and what was found. What the format
/// knows but this version cannot do is refused, unless leaving it out cannot make the picture wrong;
/// then `Scene::notes` says so.
Scene loadScene(const std::filesystem::path& file);

/// The text of a scene file. Throws Error where it cannot be read.
std::string readSceneText(const std::filesystem::path& file);

/// The same for a text in memory: paths are relative to `baseFolder`, messages call it `nameForErrors`.
Scene parseScene(std::string_view text, const std::filesystem::path& baseFolder,
                 const std::string& nameForErrors);

/// The scene as the text of a scene file that lies in `baseFolder`; all keys are written. Reading it back
/// gives an equal scene where every colour is one that sRGB hex can express; other colours become the
/// nearest. `scene` must be one that a scene file may describe.
std::string toJson(const Scene& scene, const std::filesystem::path& baseFolder = {});
/// The value of its key "style".
std::string toJson(const IllustrativeStyle& style);

}  // namespace isoglass
