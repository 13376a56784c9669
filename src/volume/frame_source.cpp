#include "volume/frame_source.h"

#include <stdexcept>

namespace isoglass {

void FrameSource::readHeights(std::size_t /*frame*/, std::span<float> /*heights*/) {
    throw std::logic_error("this source announces heights but cannot read them");
}

}  // namespace isoglass
