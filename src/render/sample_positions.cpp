#include "render/sample_positions.h"

#include <cstdint>

namespace isoglass {
namespace {

/// The bits of `i` behind the binary point, mirrored: van der Corput's sequence.
double radicalInverse(std::uint32_t i) {
    double result = 0;
    for (double digit = 0.5; i != 0; i >>= 1, digit /= 2) result += (i & 1) * digit;
    return result;
}

}  // namespace

glm::dvec2 samplePosition(int index, int count) {
    double meanInverse = 0;
    for (int i = 0; i < count; ++i) meanInverse += radicalInverse(static_cast<std::uint32_t>(i)) / count;
    return {(index + 0.5) / count - 0.5, radicalInverse(static_cast<std::uint32_t>(index)) - meanInverse};
}

}  // namespace isoglass
