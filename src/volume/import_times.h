#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace isoglass {

/// Checks the times of an import: as many as key frames, finite, strictly increasing. Throws Error with
/// the index of the first that is not; `place` says where the times are from.
void requireTimes(std::span<const double> times, std::size_t frames, const std::string& place);

}  // namespace isoglass
