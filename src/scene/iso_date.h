#pragma once

#include <string_view>

namespace isoglass {

/// True for YYYY-MM-DD, optionally followed by THH:MM or THH:MM:SS, with month 1 to 12, day 1 to 31, hour
/// up to 23, minute and second up to 59. The year 0000 is allowed. Whether the day exists depends on the
/// calendar of a series, which alone can say.
bool isIsoDate(std::string_view text);

}  // namespace isoglass
