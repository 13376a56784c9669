#include "scene/illustrative_style.h"

#include <cmath>

namespace isoglass {

double depthThresholdFromPaper(double threshold, double nearsAway, int rows, double fovDegrees) {
    constexpr double kSobelSum = 8;
    return threshold * nearsAway * rows / (kSobelSum * 2 * std::tan(fovDegrees * M_PI / 360));
}

}  // namespace isoglass
