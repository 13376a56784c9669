#pragma once

#include "surface/extract.h"

#include <glm/vec3.hpp>

namespace isoglass {

/// Gathers the n^3 samples from `first` on of a level above 0, interpolated in time and multiplied by `sign`
/// (1 or -1): z fastest. Indices are clamped to 0 .. `last`. NaN where a sample is missing. n <= 8.
void gatherBox(const TimedField& field, glm::ivec3 last, glm::ivec3 first, int n, float sign, float* out);

}  // namespace isoglass
