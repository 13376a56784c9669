#pragma once

#include "app/run_program.h"

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

namespace isoglass::test {

/// A program that runs beside the test; what it prints goes to files in its folder.
class RunningProgram {
  public:
    /// `options.folder` must be given; a limit of file sizes and a terminal are not to be had here.
    RunningProgram(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                   const RunOptions& options);
    /// Ends the program if it still runs.
    ~RunningProgram();
    RunningProgram(const RunningProgram&) = delete;
    RunningProgram& operator=(const RunningProgram&) = delete;

    /// Whole lines of its standard output so far.
    std::vector<std::string> outLines() const;
    /// Its standard error so far.
    std::string err() const;
    /// Processor time that it has taken so far.
    double cpuSeconds() const;

    /// Waits for its end; gives its exit status, 128 + signal where one ended it, -1 where it does not end
    /// within half a minute.
    int wait();

  private:
    std::string contents(const char* name) const;

    std::filesystem::path folder_;
    pid_t process_ = -1;
};

}  // namespace isoglass::test
