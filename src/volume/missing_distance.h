#pragma once

#include "volume/key_frame.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <vector>

namespace isoglass {

/// How far the corners of level-0 bricks are from missing samples, in bricks along the axes (the sum over
/// the three axes), up to 255: 0 at all corners of a brick whose cells touch one.
class MissingDistance {
  public:
    /// Linear in the number of bricks.
    explicit MissingDistance(const KeyFrame& frame);

    /// No sample is missing: every distance is 255, and nothing is stored.
    bool empty() const { return levels_.empty(); }
    /// At the corner between bricks `corner - 1` and `corner`; beyond the domain as at its end.
    int at(glm::ivec3 corner) const;
    /// Smallest over the corners in the closed brick `brick` of 2^level level-0 bricks a side.
    int smallest(int level, glm::ivec3 brick) const;
    std::size_t bytes() const;

  private:
    struct Grid {
        glm::ivec3 dims;
        std::vector<std::uint8_t> values;

        std::size_t place(glm::ivec3 i) const {
            return (static_cast<std::size_t>(i.z) * dims.y + i.y) * dims.x + i.x;
        }
    };

    Grid corners_;
    std::vector<Grid> levels_;
};

}  // namespace isoglass
