#pragma once

#include "volume/series_description.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <string>

// How a series is laid out in an OpenVDB file. Private to the room.

namespace isoglass {

/// File metadata: the description as JSON text.
inline constexpr const char* kDescriptionKey = "isoglass.series";

/// Name of the grid that holds key frame `frame`.
std::string gridName(const SeriesDescription& series, std::size_t frame);

/// Name of the grid that holds its heights, where the lattice has them.
std::string heightsGridName(const SeriesDescription& series, std::size_t frame);

/// Name of the grid that holds `level` (at least 1) of what grid `name` holds.
std::string levelGridName(const std::string& name, int level);

/// Along which axes the first sample follows the last.
glm::bvec3 periodicAxes(const Lattice& lattice);

}  // namespace isoglass
