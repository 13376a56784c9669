#pragma once

#include <cstdint>
#include <string>

namespace isoglass {

/// A number as people write it: up to 6 significant digits, no trailing zeros.
std::string formatNumber(double value);
/// "1.5 MB": decimal units, two significant digits or more.
std::string formatBytes(std::uint64_t bytes);
/// "1 min 5 s", rounded to whole seconds.
std::string formatDuration(double seconds);
/// Prints "isoglass: note: TEXT" on standard error.
void printNote(const std::string& text);

}  // namespace isoglass
