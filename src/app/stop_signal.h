#pragma once

#include <sys/types.h>

#include <exception>
#include <string>

namespace isoglass {

/// \name How SIGINT, SIGTERM and SIGHUP end the program
/// Inside a `StopScope` the first signal is only noted: the command looks with `stopRequested`, ends what it
/// is at and throws `Stopped`. Anywhere else, and at the second signal, the program ends at once; temporary
/// files and the child are removed all the same. Either way the signal is what ends the process, as shells
/// expect: they show 128 + its number.
///@{

/// Takes the three signals over, but for those that the parent made the program ignore.
void installStopSignals();

/// While one exists, a first signal waits for the command to look. One at a time.
class StopScope {
  public:
    StopScope();
    ~StopScope();
    StopScope(const StopScope&) = delete;
    StopScope& operator=(const StopScope&) = delete;
};

/// Whether a signal came. Any thread.
bool stopRequested();

/// The command ended early because a signal asked for it; `what()` says what is kept; empty for nothing.
class Stopped : public std::exception {
  public:
    explicit Stopped(std::string kept) : kept_(std::move(kept)) {}
    const char* what() const noexcept override { return kept_.c_str(); }

  private:
    std::string kept_;
};

/// Ends the process by the signal that came.
[[noreturn]] void endByStopSignal();

/// A child process that is killed where a signal ends the program at once; -1 for none.
void setChildToStop(pid_t child);
///@}

}  // namespace isoglass
