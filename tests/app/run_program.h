#pragma once

#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace isoglass::test {

/// How a program is run.
struct RunOptions {
    std::filesystem::path folder = {};  ///< working directory; empty keeps that of the test
    /// No file grows beyond this, as on a full disk.
    std::optional<std::uint64_t> fileSizeLimit = {};
    std::vector<std::string> environment = {};  ///< NAME=VALUE, on top of that of the test
    bool errIsTerminal = false;                 ///< standard error is a terminal
    /// Standard output goes there instead of into `RunResult::out`.
    std::filesystem::path outFile = {};
    /// The superuser runs it as a user who may only do what all may.
    bool dropPrivileges = false;
};

/// What a program left.
struct RunResult {
    int status = -1;  ///< exit status; 128 + signal where one ended it
    std::string out;  ///< standard output
    std::string err;  ///< standard error
};

/// A program while it runs. Its standard output is no terminal, its standard input is empty.
class StartedProgram {
  public:
    StartedProgram(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                   const RunOptions& options = {});
    /// Waits for its end.
    ~StartedProgram();

    /// Sends a signal; nothing where the program has ended.
    void signal(int number) const;
    /// Waits for its end.
    RunResult finish();

  private:
    class Drain;

    std::unique_ptr<Drain> out_;
    std::unique_ptr<Drain> err_;
    pid_t process_ = -1;
};

/// Runs a program to its end. Its standard output is no terminal, its standard input is empty.
RunResult runProgram(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                     const RunOptions& options = {});

/// Whether this system can make a terminal: without /dev/pts, as in a plain chroot, it cannot.
bool canMakeTerminal();

}  // namespace isoglass::test
