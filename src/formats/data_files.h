#pragma once

#include "formats/header_text.h"

#include <cstdint>
#include <filesystem>
#include <string_view>
#include <vector>

namespace isoglass {

/// Names made from a pattern of printf with one %d or %0Nd, for first, first + step, ... up to last.
/// Relative names lie beside the header. Errors name the header.
std::vector<std::filesystem::path> numberedFiles(std::string_view pattern, std::int64_t first,
                                                 std::int64_t last, std::int64_t step,
                                                 const HeaderText& header);

/// The names as paths, relative ones beside the header. Throws Error where there is none or too many.
std::vector<std::filesystem::path> listedFiles(const std::vector<std::string>& names,
                                               const HeaderText& header);

}  // namespace isoglass
