#pragma once

namespace isoglass {

/// Parses and runs one command. Returns the exit status: 0 on success, 1 on a failure that was reported
/// on standard error, 2 on wrong usage.
int runCommandLine(int argc, char** argv);

}  // namespace isoglass
