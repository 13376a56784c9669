#include "surface/cell_form.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace isoglass {

namespace {

/// Width of a slide, in cells of the level: sizes that far apart are far apart in the picture.
constexpr float kSlide = 0.05f;
/// Twice the share by which a level begins later than at its cell size, against rounding.
constexpr float kMargin = 2.0f / 1024;
constexpr float kNever = std::numeric_limits<float>::infinity();

}  // namespace

FormRamp::FormRamp(int level, int top, float growth)
    : fallFrom_(level == 0 ? -kNever : 1 + growth + kMargin),
      fallTo_(level == 0 ? -kNever : fallFrom_ + kSlide),
      riseFrom_(level == top ? kNever : kBlendFrom - kSlide),
      riseTo_(level == top ? kNever : kBlendFrom) {}

float FormRamp::weight(float sizeRatio) const {
    if (sizeRatio <= fallFrom_ || sizeRatio >= riseTo_) return 1;
    float weight = 0;
    if (sizeRatio < fallTo_) weight = (fallTo_ - sizeRatio) / kSlide;
    if (sizeRatio > riseFrom_) weight = std::max(weight, (sizeRatio - riseFrom_) / kSlide);
    return std::min(weight, 1.0f);
}

bool FormRamp::isCompact(float low, float high) const {
    return low >= fallTo_ && high <= riseFrom_;
}

bool FormRamp::isTetrahedral(float low, float high) const {
    return high <= fallFrom_ || low >= riseTo_;
}

float faceGate(const std::array<float, 2>& diagonal, const std::array<float, 2>& others) {
    const bool inside = others[0] >= 0;
    if (inside != (others[1] >= 0)) return 0;
    const float sharing = std::abs(diagonal[(diagonal[0] >= 0) == inside ? 0 : 1]);
    const float smaller = std::min(std::abs(others[0]), std::abs(others[1]));
    return sharing < smaller ? 1 - sharing / smaller : 0;
}

float bodyGate(const std::array<float, 8>& values, float width) {
    float smallest = kNever;
    float largest = 0;
    for (const float value : values) {
        smallest = std::min(smallest, std::abs(value));
        largest = std::max(largest, std::abs(value));
    }
    const float reach = width * largest;
    return smallest < reach ? 1 - smallest / reach : 0;
}

}  // namespace isoglass
