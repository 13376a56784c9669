#pragma once

#include "pipeline/scene_extractor.h"
#include "scene/scene.h"

#include <glm/vec2.hpp>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace isoglass {

/// A scene whose series are open.
struct Opened {
    std::string name;  ///< of the file, for people
    Scene scene;
    std::unique_ptr<SceneExtractor> extractor;
    std::vector<std::string> notes;  ///< what the user should know of it, a sentence each

    /// Positions of all key frames on the scene's timeline (0 is its `from`, 1 its `to`), sorted.
    std::vector<double> keyPositions() const;
};

struct OpenOptions {
    SceneExtractor::Options scene;
    bool showLevels = false;  ///< see colorByLevel
};

/// Opens a scene file, or a series or mesh with the scene of `makeFirstScene`, which is `firstSize` pixels
/// large. Reads every series once, to check it. Any thread. Throws Error.
Opened openForViewing(const std::filesystem::path& file, glm::ivec2 firstSize, const OpenOptions& options);

/// A moment of a series for people: "2005-08-28 12:00" where it has dates, else the time with its units.
/// Seconds are shown where key frames are less than a minute apart.
std::string momentText(const TimeAxis& axis, double time);

}  // namespace isoglass
