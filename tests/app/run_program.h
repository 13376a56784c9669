#pragma once

#include <cstdint>
#include <filesystem>
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
};

/// What a program left.
struct RunResult {
    int status = -1;  ///< exit status; 128 + signal where one ended it
    std::string out;  ///< standard output
    std::string err;  ///< standard error
};

/// Runs a program to its end. Its standard output is no terminal, its standard input is empty.
RunResult runProgram(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                     const RunOptions& options = {});

/// Whether this system can make a terminal: without /dev/pts, as in a plain chroot, it cannot.
bool canMakeTerminal();

}  // namespace isoglass::test
