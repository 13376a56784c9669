#pragma once

#include "volume/key_frame.h"

#include <cstdint>

namespace isoglass {

/// CRC-32 of the valid samples of a key frame with their places: the same for the same samples stored
/// in the same bricks, whatever the values of missing samples and the number of threads.
std::uint32_t checksum(const KeyFrame& frame);

}  // namespace isoglass
