#include "app/view/screenshots.h"

#include "render/png_file.h"

#include <array>
#include <ctime>
#include <exception>

namespace isoglass {

Screenshots::Screenshots(Report report) : report_(std::move(report)), thread_([this] { run(); }) {}

Screenshots::~Screenshots() {
    queue_.close();
}

void Screenshots::run() {
    while (const auto picture = queue_.pop()) {
        Outcome outcome;
        try {
            outcome.file = screenshotFile(picture->name, std::time(nullptr));
            writePng(outcome.file, picture->image);
        } catch (const std::exception& error) {
            outcome.error = error.what();
        }
        report_(outcome);
    }
}

std::filesystem::path screenshotFile(const std::string& name, std::time_t when) {
    std::tm local{};
    ::localtime_r(&when, &local);
    std::array<char, 32> time{};
    std::strftime(time.data(), time.size(), "%Y%m%d-%H%M%S", &local);
    const std::string stem = std::filesystem::path(name).filename().string() + "-" + time.data();
    std::filesystem::path file = stem + ".png";
    for (int i = 2; std::filesystem::exists(file); ++i) file = stem + "-" + std::to_string(i) + ".png";
    return file;
}

}  // namespace isoglass
