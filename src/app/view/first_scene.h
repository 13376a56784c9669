#pragma once

#include "scene/scene.h"
#include "volume/series_file.h"

#include <glm/vec2.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace isoglass {

/// An iso-value that somebody who knows nothing of a field may begin with.
struct SuggestedIso {
    double iso = 0;
    double share = 0;  ///< of the samples that are not background, how many are at least `iso`
};

/// Suggested iso-values and what they rest on.
struct IsoSuggestion {
    std::vector<SuggestedIso> values;  ///< decreasing; empty where all samples are the same
    /// The value that at least a quarter of the samples share (air, no cloud), which is left out.
    std::optional<double> background;
};

/// Two iso-values between the smallest and the largest sample: a fifth of the samples that are not
/// background reach the first, seven tenths reach the second. Missing samples (NaN) must not be among them;
/// they are sorted.
IsoSuggestion suggestIsoValues(std::vector<float> samples);

/// A scene that shows a series of which nothing else is known, and why it is that scene.
struct FirstScene {
    Scene scene;
    std::vector<std::string> reasons;  ///< a sentence each, without a full stop
};

/// An opaque surface and a semi-transparent one around it, at values taken from the key frame in the middle
/// of the series (where that is constant, from the one whose samples differ most); half a second for each key
/// frame; a camera that sees the whole domain from the south-west and above. Where height has other units
/// than the horizontal axes it is scaled to a third of them.
FirstScene makeFirstScene(const SeriesFile& series, glm::ivec2 size);

/// The same for a mesh file. Throws Error where it cannot be read or is empty.
FirstScene makeMeshScene(const std::filesystem::path& file, glm::ivec2 size);

}  // namespace isoglass
