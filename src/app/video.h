#pragma once

#include "base/atomic_file.h"
#include "render/image.h"

#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

namespace isoglass {

/// Encodes frames to an MP4 (H.264) through the ffmpeg program.
///
/// The file appears under its name only after `finish`. Use from one thread.
class VideoWriter {
  public:
    /// Starts ffmpeg. Throws Error where it cannot be found or the file cannot be written.
    VideoWriter(const std::filesystem::path& file, glm::ivec2 size, double fps);
    /// Ends ffmpeg and removes what was not finished.
    ~VideoWriter();

    /// Appends one frame of the size given at the start. Throws Error, with ffmpeg's last words, where
    /// encoding has failed.
    void add(const Image& image);

    /// Waits for ffmpeg and puts the file in its place. Throws Error like `add`.
    void finish();

  private:
    /// What ffmpeg says; removed at the end.
    struct Log {
        std::filesystem::path path;
        ~Log();
    };

    [[noreturn]] void fail();
    int waitForEnd();

    std::filesystem::path file_;
    AtomicFile target_;
    Log log_;
    pid_t process_ = -1;
    int pipe_ = -1;
};

}  // namespace isoglass
