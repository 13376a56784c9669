#pragma once

#include "basis/bounded_queue.h"
#include "render/image.h"

#include <ctime>
#include <filesystem>
#include <functional>
#include <string>
#include <thread>

namespace isoglass {

/// Writes pictures to files on a thread of its own, so that nobody waits for the disk.
class Screenshots {
  public:
    /// A picture was saved under that name, or could not be: why. Called on the writing thread.
    struct Outcome {
        std::filesystem::path file;
        std::string error;
    };
    using Report = std::function<void(const Outcome&)>;

    explicit Screenshots(Report report);
    /// Writes what is still waiting.
    ~Screenshots();

    /// `name` begins the file's name; the time of day and .png follow. Waits only where many pictures
    /// already do. Any thread.
    void save(Image image, std::string name) { queue_.push({std::move(image), std::move(name)}); }

  private:
    struct Picture {
        Image image;
        std::string name;
    };

    void run();

    Report report_;
    BoundedQueue<Picture> queue_{16};
    std::jthread thread_;  ///< last member: it uses all the others
};

/// "storm-20260131-235959.png" in the working folder, or with "-2", "-3", ... where that exists. `name` loses
/// what could lead out of the folder.
std::filesystem::path screenshotFile(const std::string& name, std::time_t when);

}  // namespace isoglass
