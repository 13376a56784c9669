#pragma once

#include "scene/volume_style.h"

#include <glm/vec4.hpp>

#include <vector>

namespace isoglass {

/// A style's colours and opacities as shaders look them up.
struct TransferTable {
    static constexpr int kEntries = 1024;
    static constexpr int kBins = 64;

    float low = 0;    ///< value of the first entry; smaller ones are as it is
    float scale = 0;  ///< entries a value; 0 where all values are alike
    /// Linear in between: color, and opacity of a unit.
    std::vector<glm::vec4> entries;
    /// Row a, column b: 1 where any value in the bins a to b has an opacity, else 0. Bins are as wide as
    /// (kEntries - 1) / kBins entries; what lies beyond the entries counts to the first and the last.
    std::vector<float> visible;
};

TransferTable makeTransferTable(const VolumeStyle& style);

}  // namespace isoglass
