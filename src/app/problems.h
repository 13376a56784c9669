#pragma once

#include "base/error.h"

#include <filesystem>
#include <string>
#include <vector>

namespace isoglass {

/// Something that `validate` has to say.
struct Problem {
    enum class Severity { error, warning };

    Severity severity = Severity::error;
    std::string what = {};
    std::string file = {};
    std::string pointer = {};  ///< JSON pointer in a scene file; empty for other files and places
    std::string place = {};    ///< what else is known of the place: line and column, key frame; may be empty
    std::string hint = {};     ///< how to mend it; may be empty
};

/// Everything that is wrong with a scene file and with the series that it names, checksums of all key frames
/// included, as far as one error does not hide another.
std::vector<Problem> problemsOfScene(const std::filesystem::path& file);

/// Everything that is wrong with a series: its seal and, where that holds, the checksum of every key frame.
std::vector<Problem> problemsOfSeries(const std::filesystem::path& file);

}  // namespace isoglass
