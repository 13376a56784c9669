#pragma once

#include "app/ffmpeg.h"
#include "base/atomic_file.h"
#include "render/image.h"

#include <filesystem>
#include <vector>

namespace isoglass {

/// Encodes frames to an MP4 (H.264) through the ffmpeg program.
///
/// The file appears under its name only after `finish`. The same frames give the same bytes. Use from one
/// thread.
class VideoWriter {
  public:
    /// Starts ffmpeg. Throws Error where it cannot be run or the file cannot be written; `named` is the
    /// file that messages name.
    VideoWriter(const std::filesystem::path& file, glm::ivec2 size, double fps,
                const std::filesystem::path& named);

    /// Appends one frame of the size given at the start. Throws Error, with ffmpeg's last words, where
    /// encoding has failed.
    void add(const Image& image);

    /// Waits for ffmpeg and puts the file in its place. Throws Error like `add`.
    void finish();

  private:
    AtomicFile target_;
    Ffmpeg ffmpeg_;
};

/// Puts videos of `VideoWriter`, all of one size and rate, one after the other into `out` without encoding
/// them again. They lie in `folder`, where a list of them is made for a moment. Throws Error.
void joinVideos(const std::filesystem::path& folder, const std::vector<std::filesystem::path>& names,
                const std::filesystem::path& out);

}  // namespace isoglass
