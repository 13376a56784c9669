#pragma once

#include "numeric/hard_cases.h"

#include <glm/vec3.hpp>

#include <functional>
#include <vector>

// The parts that `hardCases` is put together from.

namespace isoglass::numeric {

std::vector<HardCase> equalSampleCases();   ///< samples equal to the iso-value, plateaus
std::vector<HardCase> signCases();          ///< ambiguous cells, random signs
std::vector<HardCase> specialValueCases();  ///< NaN, infinities, denormals, ranges, outliers
std::vector<HardCase> latticeCases();       ///< steps, sizes, thin domains and sheets
std::vector<HardCase> timeCases();          ///< between two key frames

/// Samples at whole numbers from 0.
Lattice unitLattice(glm::ivec3 dims);

/// Dense samples of a function of the sample's index.
std::vector<float> fill(glm::ivec3 dims, const std::function<float(glm::ivec3)>& value);

/// Radius minus the distance from the middle of the lattice, in samples.
std::vector<float> ball(glm::ivec3 dims, double radius);

}  // namespace isoglass::numeric
