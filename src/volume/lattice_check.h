#pragma once

#include "volume/lattice.h"

#include <string>

namespace isoglass {

/// Largest magnitude of a coordinate, and smallest step between two: beyond them positions, or differences
/// over a step, are no floats.
inline constexpr double kLargestCoordinate = 1e30;
inline constexpr double kSmallestStep = 1e-30;

/// Checks these two of a lattice whose axes are monotonic and finite. Throws Error; `place` says where the
/// lattice is from.
void requireUsable(const Lattice& lattice, const std::string& place);

}  // namespace isoglass
