#pragma once

#include "volume/frame_source.h"

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace isoglass {

/// One foreign file, which holds one key frame or several.
class FileSource : public FrameSource {
  public:
    /// Whether the file itself says when its key frames are. Else `description().time` counts 0, 1, 2, ...
    virtual bool knowsTimes() const = 0;
};

/// Opens one file; `variable` is empty or names the variable to read. Throws Error.
using OpenFile = std::function<std::unique_ptr<FileSource>(const std::filesystem::path& file,
                                                           const std::string& variable)>;

/// Longest axis and largest key frame that are believed: a header announces any size in a few bytes.
inline constexpr std::uint64_t kLongestAxis = std::uint64_t{1} << 20;
inline constexpr std::uint64_t kMostSamples = std::uint64_t{1} << 34;

/// Checks the lengths of the three axes (2 samples to `kLongestAxis`, `kMostSamples` in all) and returns
/// the product. Throws Error, with `place` naming the file.
std::uint64_t requireVolume(std::span<const std::uint64_t> dims, const std::string& place);

/// Refuses a variable for a format whose files hold one field without a name. Throws Error.
void refuseVariable(const std::string& variable, const std::string& format);

/// Chains files of one lattice into one source. The times are `options.times` if given, else `times` (from
/// an index file) if given, else those of the files if all of them know theirs, else 0, 1, 2, ...
/// One file is open at a time; the header of every file is read at once. Throws Error where the files do
/// not agree, naming the file.
std::unique_ptr<FrameSource> openSequence(std::span<const std::filesystem::path> files, const OpenFile& open,
                                          const ImportOptions& options, const std::string& format,
                                          const std::vector<double>& times = {});

}  // namespace isoglass
