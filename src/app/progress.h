#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace isoglass {

/// Shows how far a long job is, on standard error, with its rate and the time left.
///
/// On a terminal one line is drawn again and again; elsewhere, or with NO_COLOR set, a plain line is
/// printed now and then.
class Progress {
  public:
    /// `what` is the job ("rendering"), `unit` what is counted ("frames").
    Progress(std::string what, std::string unit, std::int64_t total);
    /// Ends the line.
    ~Progress();

    void update(std::int64_t done);

  private:
    using Clock = std::chrono::steady_clock;

    std::string what_;
    std::string unit_;
    std::int64_t total_;
    bool redraw_;
    Clock::time_point start_ = Clock::now();
    Clock::time_point lastShown_ = start_;
};

}  // namespace isoglass
