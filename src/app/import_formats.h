#pragma once

#include "volume/frame_source.h"

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace isoglass {

/// A foreign format: how it is known and opened.
struct ImportFormat {
    std::string_view name;     ///< for people: "MetaImage"
    std::string_view endings;  ///< between blanks: ".mha .mhd"
    bool available;            ///< in this build
    bool takesHeights;         ///< `ImportOptions::height` means something
    /// Whether a file that begins with `start` (its first kibibyte, decompressed) is of this format.
    bool (*begins)(std::string_view start);
    /// The format's files, one key frame each or more; a format of one file refuses a second. Null where it
    /// is not available.
    std::unique_ptr<FrameSource> (*open)(std::span<const std::filesystem::path> files,
                                         const ImportOptions& options);
};

/// For `import --help`: a line a format, those not in this build included.
std::string listImportFormats();

/// What the file is by its content, else by its name. Throws Error where it is nothing known, or of a format
/// that this build has not.
const ImportFormat& findImportFormat(const std::filesystem::path& file);

}  // namespace isoglass
