#include "volume/brick_fates.h"

#include "basis/parallel.h"
#include "volume/key_frame.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace isoglass {

namespace {

/// Side of two sets of samples together.
BrickSide merge(BrickSide a, BrickSide b) {
    if (a == BrickSide::none) return b;
    if (b == BrickSide::none || a == b) return a;
    return BrickSide::across;
}

/// Side of every brick together with its neighbours along one axis.
std::vector<BrickSide> spread(const std::vector<BrickSide>& sides, glm::ivec3 bricks, int axis,
                              bool periodic) {
    std::vector<BrickSide> result(sides.size());
    const std::ptrdiff_t stride = axis == 0   ? 1
                                  : axis == 1 ? bricks.x
                                              : static_cast<std::ptrdiff_t>(bricks.x) * bricks.y;
    const std::ptrdiff_t length = bricks[axis];
    for (std::size_t i = 0; i < sides.size(); ++i) {
        const std::ptrdiff_t place = static_cast<std::ptrdiff_t>(i) / stride % length;
        BrickSide side = sides[i];
        for (const int step : {-1, 1}) {
            std::ptrdiff_t next = place + step;
            if (periodic) next = (next + length) % length;
            if (next >= 0 && next < length) side = merge(side, sides[i + (next - place) * stride]);
        }
        result[i] = side;
    }
    return result;
}

}  // namespace

std::vector<BrickSide> brickSides(glm::ivec3 dims, std::span<const float> samples, ValueRange keep) {
    const glm::ivec3 bricks = (dims + (kBrickSize - 1)) / kBrickSize;
    std::vector<BrickSide> sides(static_cast<std::size_t>(bricks.x) * bricks.y * bricks.z, BrickSide::none);
    for (int z = 0; z < dims.z; ++z) {
        for (int y = 0; y < dims.y; ++y) {
            const float* row = &samples[(static_cast<std::size_t>(z) * dims.y + y) * dims.x];
            BrickSide* side =
                &sides[(static_cast<std::size_t>(z / kBrickSize) * bricks.y + y / kBrickSize) * bricks.x];
            for (int x = 0; x < dims.x; ++x) {
                if (std::isnan(row[x])) continue;
                const BrickSide own = row[x] < keep.min   ? BrickSide::below
                                      : row[x] > keep.max ? BrickSide::above
                                                          : BrickSide::across;
                side[x / kBrickSize] = merge(side[x / kBrickSize], own);
            }
        }
    }
    return sides;
}

std::vector<std::vector<BrickFate>> fatesToKeep(const Lattice& lattice,
                                                const std::vector<std::vector<BrickSide>>& sides, bool cyclic,
                                                ValueRange keep) {
    const glm::ivec3 bricks = (lattice.dims() + (kBrickSize - 1)) / kBrickSize;
    std::vector<std::vector<BrickSide>> wide(sides);
    for (auto& frame : wide) {
        for (int axis = 0; axis < 3; ++axis) {
            frame = spread(frame, bricks, axis, lattice.axes[axis].period.has_value());
        }
    }
    const std::size_t count = sides.size();
    std::vector<std::vector<BrickFate>> fates(count);
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t before = i > 0 ? i - 1 : cyclic ? count - 1 : i;
        const std::size_t after = i + 1 < count ? i + 1 : cyclic ? 0 : i;
        fates[i].resize(wide[i].size());
        for (std::size_t b = 0; b < fates[i].size(); ++b) {
            const BrickSide side = merge(wide[i][b], merge(wide[before][b], wide[after][b]));
            if (side == BrickSide::below) {
                fates[i][b] = {BrickFate::Kind::constant,
                               std::nextafter(keep.min, -std::numeric_limits<float>::infinity())};
            } else if (side == BrickSide::above) {
                fates[i][b] = {BrickFate::Kind::constant,
                               std::nextafter(keep.max, std::numeric_limits<float>::infinity())};
            }
        }
    }
    return fates;
}

}  // namespace isoglass
