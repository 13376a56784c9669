#include "app/progress.h"

#include "app/text.h"

#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <iostream>
#include <sstream>

namespace isoglass {

namespace {

constexpr std::chrono::milliseconds kRedrawInterval(100);
constexpr std::chrono::seconds kLineInterval(5);

}  // namespace

Progress::Progress(std::string what, std::string unit, std::int64_t total)
    : what_(std::move(what)),
      unit_(std::move(unit)),
      total_(total),
      redraw_(::isatty(STDERR_FILENO) == 1 && !std::getenv("NO_COLOR")) {}

Progress::~Progress() {
    if (redraw_) std::cerr << '\n';
}

void Progress::update(std::int64_t done) {
    const auto now = Clock::now();
    const bool last = done == total_;
    if (!last &&
        now - lastShown_ < (redraw_ ? Clock::duration(kRedrawInterval) : Clock::duration(kLineInterval))) {
        return;
    }
    lastShown_ = now;
    const double seconds = std::chrono::duration<double>(now - start_).count();
    const double rate = seconds > 0 ? static_cast<double>(done) / seconds : 0;
    std::ostringstream line;
    line << what_ << ' ' << done << '/' << total_ << ' ' << unit_;
    if (rate > 0) line << ", " << formatNumber(std::round(rate * 10) / 10) << ' ' << unit_ << "/s";
    if (last) {
        line << ", took " << formatDuration(seconds);
    } else if (rate > 0) {
        line << ", " << formatDuration(static_cast<double>(total_ - done) / rate) << " left";
    }
    // Erasing to the end of the line is the one escape code a redrawn line needs.
    std::cerr << (redraw_ ? "\r\x1b[K" : "") << line.str() << (redraw_ ? "" : "\n") << std::flush;
}

}  // namespace isoglass
