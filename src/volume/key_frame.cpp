#include "volume/key_frame.h"

#include "basis/parallel.h"
#include "volume/detail_error.h"
#include "volume/pyramid.h"

#include <glm/common.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace isoglass {

namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr std::size_t kBricksPerTask = 256;

/// Ranges of a brick's samples, restricted to the first plane of every axis whose bit is set.
using PartRanges = std::array<ValueRange, 8>;

void include(ValueRange& range, ValueRange other) {
    range.min = std::min(range.min, other.min);
    range.max = std::max(range.max, other.max);
}

/// `inside` is how many samples of each axis lie inside the domain.
PartRanges partRanges(const BrickView& brick, glm::ivec3 inside) {
    PartRanges parts;
    parts.fill({kInfinity, -kInfinity});
    if (brick.missing) return parts;
    if (!brick.samples) {
        parts.fill({brick.constant, brick.constant});
        return parts;
    }
    for (int x = 0; x < inside.x; ++x) {
        for (int y = 0; y < inside.y; ++y) {
            ValueRange first{kInfinity, -kInfinity};
            ValueRange row{kInfinity, -kInfinity};
            for (int z = 0; z < inside.z; ++z) {
                if (brick.valid && !(brick.valid[x] >> (y * kBrickSize + z) & 1)) continue;
                const float value = brick.samples[(x * kBrickSize + y) * kBrickSize + z];
                include(row, {value, value});
                if (z == 0) first = row;
            }
            for (int part = 0; part < 8; ++part) {
                if ((part & 1 && x > 0) || (part & 2 && y > 0)) continue;
                include(parts[part], part & 4 ? first : row);
            }
        }
    }
    return parts;
}

}  // namespace

KeyFrame::KeyFrame(glm::ivec3 dims, glm::bvec3 periodic, Pool pool, std::vector<BrickView> bricks,
                   std::vector<std::uint32_t> brickIndex, std::shared_ptr<const KeyFrame> heights)
    : dims_(dims),
      periodic_(periodic),
      brickDims_((dims + (kBrickSize - 1)) / kBrickSize),
      pool_(std::move(pool)),
      bricks_(std::move(bricks)),
      brickIndex_(std::move(brickIndex)),
      heights_(std::move(heights)) {
    computeRanges(periodic);
}

KeyFrame::~KeyFrame() = default;

const Pyramid& KeyFrame::pyramid() const {
    std::call_once(pyramidOnce_, [this] { pyramid_ = std::make_unique<const Pyramid>(*this); });
    return *pyramid_;
}

const DetailError& KeyFrame::detailError() const {
    std::call_once(detailErrorOnce_,
                   [this] { detailError_ = std::make_unique<const DetailError>(*this, pyramid()); });
    return *detailError_;
}

void KeyFrame::computeRanges(glm::bvec3 periodic) {
    std::vector<PartRanges> parts(bricks_.size());
    const auto position = [this](std::size_t i) {
        return glm::ivec3(i % brickDims_.x, i / brickDims_.x % brickDims_.y,
                          i / (static_cast<std::size_t>(brickDims_.x) * brickDims_.y));
    };
    parallelFor(bricks_.size(), kBricksPerTask, 0, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            if (!bricks_[i].samples) parts[i] = partRanges(bricks_[i], glm::ivec3(kBrickSize));
        }
    });
    parallelFor(brickIndex_.size(), kBricksPerTask, 0, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const BrickView& view = brick(i);
            if (!view.samples) continue;
            parts[brickIndex_[i]] =
                partRanges(view, glm::min(dims_ - position(i) * kBrickSize, glm::ivec3(kBrickSize)));
        }
    });
    ranges_.resize(brickIndex_.size());
    parallelFor(brickIndex_.size(), kBricksPerTask, 0, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            ValueRange range{kInfinity, -kInfinity};
            const glm::ivec3 base = position(i);
            for (int part = 0; part < 8; ++part) {
                glm::ivec3 next = base + glm::ivec3(part & 1, part >> 1 & 1, part >> 2);
                bool exists = true;
                for (int k = 0; k < 3; ++k) {
                    if (next[k] < brickDims_[k]) continue;
                    next[k] = 0;
                    exists = exists && periodic[k];
                }
                if (exists) include(range, parts[brickIndex_[linear(next)]][part]);
            }
            ranges_[i] = range;
        }
    });
}

float KeyFrame::sample(glm::ivec3 index) const {
    const BrickView& view = brick(linear(index / kBrickSize));
    const glm::ivec3 local = index % kBrickSize;
    if (view.missing) return std::numeric_limits<float>::quiet_NaN();
    if (!view.samples) return view.constant;
    if (view.valid && !(view.valid[local.x] >> (local.y * kBrickSize + local.z) & 1)) {
        return std::numeric_limits<float>::quiet_NaN();
    }
    return view.samples[(local.x * kBrickSize + local.y) * kBrickSize + local.z];
}

std::size_t KeyFrame::bytes() const {
    return pool_.samples.size() * sizeof(float) + pool_.valid.size() * sizeof(std::uint64_t) +
           bricks_.size() * sizeof(BrickView) + brickIndex_.size() * sizeof(std::uint32_t) +
           ranges_.size() * sizeof(ValueRange) + (heights_ ? heights_->bytes() : 0);
}

}  // namespace isoglass
