#pragma once

#include "base/signal_cleanup.h"

#include <sys/types.h>

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace isoglass {

/// One run of the ffmpeg program, fed through its standard input. Use from one thread.
class Ffmpeg {
  public:
    /// Starts it. `out` is the file that messages name; what ffmpeg says goes to a file beside `temporary`,
    /// which is removed at the end. Throws Error where the program cannot be run.
    Ffmpeg(std::vector<std::string> arguments, std::filesystem::path out,
           const std::filesystem::path& temporary);
    /// Ends it where it still runs.
    ~Ffmpeg();
    Ffmpeg(const Ffmpeg&) = delete;
    Ffmpeg& operator=(const Ffmpeg&) = delete;

    /// Throws Error, with ffmpeg's last words, where it has failed.
    void write(const void* data, std::size_t size);

    /// Closes its input and waits for its end. Throws Error like `write`.
    void finish();

  private:
    struct Log {
        std::filesystem::path path;
        NotedFile noted{path};
        ~Log();
    };

    [[noreturn]] void fail();
    int waitForEnd();

    std::filesystem::path out_;
    Log log_;
    pid_t process_ = -1;
    int pipe_ = -1;
};

}  // namespace isoglass
