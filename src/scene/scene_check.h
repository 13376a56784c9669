#pragma once

#include "base/error.h"
#include "scene/scene.h"

#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace isoglass {

/// What is wrong with a scene file.
struct SceneProblems {
    std::vector<Error> errors;  ///< in the order in which they were found; the place ends in a JSON pointer
    /// The scene without what is wrong in it, for further checks; nothing where too little is left.
    std::optional<Scene> rest;
    /// JSON pointers of what was left out or replaced in `rest`: nothing may be said of those.
    std::set<std::string> replaced;

    /// Whether the value at the pointer, or one around it, was left out or replaced.
    bool touches(const std::string& pointer) const;
};

/// Finds as many errors of a scene file as can be told apart, not only the first: what the reader
/// complains of is left out, or gets a harmless value where it is required, and the rest is read again. So
/// this knows every rule that the reader knows. A text that is no JSON, or repeats a key, has that one error.
SceneProblems checkScene(std::string_view text, const std::filesystem::path& baseFolder,
                         const std::string& nameForErrors);

}  // namespace isoglass
