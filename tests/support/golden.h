#pragma once

#include "render/image.h"
#include "support/image_compare.h"

#include <string>

namespace isoglass::test {

/// Compares with the picture tests/golden/images/NAME.png, which somebody looked at. Empty where they agree
/// within the limits; else what differs. A missing picture is a difference. With ISOGLASS_UPDATE_GOLDEN in
/// the environment the picture is written, and that is reported as a difference too: look at it, commit it
/// with the reason, and run the test again.
std::string differenceFromGolden(const std::string& name, const Image& actual, const ImageLimits& limits);

}  // namespace isoglass::test
