#include "volume/missing_distance.h"

#include "volume/pyramid.h"

#include <glm/common.hpp>

#include <algorithm>

namespace isoglass {

namespace {

constexpr int kFar = 255;

bool lacksSamples(const KeyFrame& frame, glm::ivec3 brick) {
    for (int k = 0; k < 3; ++k) {
        if (brick[k] < frame.brickDims()[k]) continue;
        if (!frame.periodic()[k]) return false;
        brick[k] = 0;
    }
    const BrickView& view = frame.brick(frame.linear(brick));
    return view.missing || view.valid;
}

template <typename Visit>
void forEach(glm::ivec3 dims, Visit visit) {
    glm::ivec3 i;
    for (i.z = 0; i.z < dims.z; ++i.z) {
        for (i.y = 0; i.y < dims.y; ++i.y) {
            for (i.x = 0; i.x < dims.x; ++i.x) visit(i);
        }
    }
}

}  // namespace

MissingDistance::MissingDistance(const KeyFrame& frame) {
    const glm::ivec3 bricks = (frame.cells() + (kBrickSize - 1)) / kBrickSize;
    corners_.dims = bricks + 1;
    corners_.values.assign(static_cast<std::size_t>(corners_.dims.x) * corners_.dims.y * corners_.dims.z,
                           kFar);
    bool any = false;
    forEach(bricks, [&](glm::ivec3 brick) {
        // The brick's last cells have their other samples in the next bricks.
        bool touches = false;
        for (int next = 0; next < 8 && !touches; ++next)
            touches = lacksSamples(frame, brick + glm::ivec3(next & 1, next >> 1 & 1, next >> 2));
        if (!touches) return;
        any = true;
        for (int corner = 0; corner < 8; ++corner) {
            corners_.values[corners_.place(brick + glm::ivec3(corner & 1, corner >> 1 & 1, corner >> 2))] = 0;
        }
    });
    if (!any) {
        corners_ = {};
        return;
    }
    const auto relax = [&](glm::ivec3 i, int axis, int step) {
        glm::ivec3 from = i;
        from[axis] += step;
        if (from[axis] < 0 || from[axis] >= corners_.dims[axis]) return;
        std::uint8_t& value = corners_.values[corners_.place(i)];
        value = static_cast<std::uint8_t>(
            std::min<int>(value, std::min(kFar, corners_.values[corners_.place(from)] + 1)));
    };
    for (int axis = 0; axis < 3; ++axis) {
        forEach(corners_.dims, [&](glm::ivec3 i) { relax(i, axis, -1); });
        forEach(corners_.dims, [&](glm::ivec3 i) { relax(corners_.dims - 1 - i, axis, 1); });
    }

    Grid lowest{bricks, std::vector<std::uint8_t>(static_cast<std::size_t>(bricks.x) * bricks.y * bricks.z)};
    forEach(bricks, [&](glm::ivec3 brick) {
        int value = kFar;
        for (int corner = 0; corner < 8; ++corner)
            value = std::min(value, at(brick + glm::ivec3(corner & 1, corner >> 1 & 1, corner >> 2)));
        lowest.values[lowest.place(brick)] = static_cast<std::uint8_t>(value);
    });
    levels_.push_back(std::move(lowest));
    for (int level = 1; level <= topLevel(frame.cells()); ++level) {
        const Grid& fine = levels_.back();
        Grid coarse{(fine.dims + 1) / 2, {}};
        coarse.values.assign(static_cast<std::size_t>(coarse.dims.x) * coarse.dims.y * coarse.dims.z, kFar);
        forEach(fine.dims, [&](glm::ivec3 i) {
            std::uint8_t& value = coarse.values[coarse.place(i / 2)];
            value = std::min(value, fine.values[fine.place(i)]);
        });
        levels_.push_back(std::move(coarse));
    }
}

int MissingDistance::at(glm::ivec3 corner) const {
    if (corners_.values.empty()) return kFar;
    return corners_.values[corners_.place(glm::min(corner, corners_.dims - 1))];
}

int MissingDistance::smallest(int level, glm::ivec3 brick) const {
    return levels_.empty() ? kFar : levels_[level].values[levels_[level].place(brick)];
}

std::size_t MissingDistance::bytes() const {
    std::size_t sum = corners_.values.size();
    for (const Grid& grid : levels_) sum += grid.values.size();
    return sum;
}

}  // namespace isoglass
