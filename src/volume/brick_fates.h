#pragma once

#include "volume/lattice.h"
#include "volume/series_description.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <span>
#include <vector>

// Which bricks a series can do without when only some iso-values matter. Private to the room.

namespace isoglass {

/// What becomes of one brick of a dense frame.
struct BrickFate {
    enum class Kind : std::uint8_t { stored, constant };
    Kind kind = Kind::stored;
    float constant = 0;
};

/// On which side of an interval of iso-values the valid samples of a brick lie.
enum class BrickSide : std::uint8_t { none, below, above, across };

/// Side of every brick (x fastest) of a dense frame (x fastest, NaN = missing): `none` has no valid
/// sample, `below` has all under keep.min, `above` all over keep.max.
std::vector<BrickSide> brickSides(glm::ivec3 dims, std::span<const float> samples, ValueRange keep);

/// Decides for every key frame which bricks become one value: those that lie on one side together with
/// all 26 neighbours, in their own and the two neighbouring key frames (across the end of a `cyclic`
/// series too). A cell that a kept surface crosses then has its 8 samples, and those next to them that
/// the gradient needs, in stored bricks, at every time between key frames.
std::vector<std::vector<BrickFate>> fatesToKeep(const Lattice& lattice,
                                                const std::vector<std::vector<BrickSide>>& sides, bool cyclic,
                                                ValueRange keep);

}  // namespace isoglass
