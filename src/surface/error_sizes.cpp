#include "surface/error_sizes.h"

#include "basis/parallel.h"
#include "surface/time_range.h"
#include "volume/detail_error.h"

#include <glm/common.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace isoglass {

namespace {

constexpr std::size_t kBlocksPerTask = 256;
/// Least gradient, as a share of half the range of the field.
constexpr float kLeastGradient = 1e-6f;
constexpr float kUnlimited = std::numeric_limits<float>::max();

/// What the blocks of one moment say.
class Blocks {
  public:
    explicit Blocks(const TimedField& field)
        : a_((field.fraction == 1 ? field.b : field.a)->detailError()),
          b_(field.fraction > 0 && field.fraction < 1 ? &field.b->detailError() : nullptr),
          fraction_(field.fraction) {}

    const DetailError& shape() const { return a_; }
    float gradient(std::size_t block) const {
        return mixed(a_.gradient(block), [&] { return b_->gradient(block); });
    }
    float bound(std::size_t block, int level) const {
        return mixed(a_.bound(block, level), [&] { return b_->bound(block, level); });
    }
    ValueRange range(std::size_t block) const {
        return b_ ? inTime(a_.range(block), b_->range(block)) : a_.range(block);
    }

    ValueRange wholeRange() const { return b_ ? inTime(a_.wholeRange(), b_->wholeRange()) : a_.wholeRange(); }
    ValueRange reach(int up, glm::ivec3 cube) const {
        return b_ ? inTime(a_.reach(up, cube), b_->reach(up, cube)) : a_.reach(up, cube);
    }

  private:
    ValueRange inTime(ValueRange a, ValueRange b) const { return rangeInTime(a, b, fraction_); }

    template <typename Other>
    float mixed(float a, const Other& b) const {
        return b_ ? a + fraction_ * (b() - a) : a;
    }

    const DetailError& a_;
    const DetailError* b_;
    float fraction_;
};

/// How much a block counts: 1 where its range holds the iso-value, 0 from DetailError::kReach steps away on.
float weightOf(ValueRange range, float iso, float step) {
    if (!(range.min <= range.max)) return 0;
    const float distance = std::max({range.min - iso, iso - range.max, 0.0f});
    if (distance == 0) return 1;
    return std::max(0.0f, 1 - distance / (DetailError::kReach * step));
}

/// Bounds are largest values over a block and sums over levels. On smooth fields the displacement of 99.9 of
/// 100 vertices was measured to be about a quarter of them; half leaves room.
constexpr float kShareOfBound = 0.5f;
/// Sizes in units of a level's cells: where its displacement is just allowed, and where the next level begins
/// to blend in. In between its cells are compact; see FormRamp.
constexpr float kFirstSize = 1.3f;
constexpr float kLastSize = 1.8f;

/// Size for what the eye can tell apart between the displacement by a level (0) and by the next (1): slow
/// where it only says that the level is fine, fast where levels change, which takes three times the
/// triangles.
float sizeInLevel(float share) {
    constexpr float kSlow = 0.8f;
    if (share < kSlow) return kFirstSize + share / kSlow * (kLastSize - kFirstSize);
    return kLastSize + (share - kSlow) / (1 - kSlow) * (2 * kFirstSize - kLastSize);
}

/// Size at which the displacement is `allowed` cells.
float sizeFor(const Blocks& blocks, std::size_t block, float cellsPerValue, float allowed) {
    constexpr float kShare = static_cast<float>(kErrorPerCell);
    float before = kShare;
    if (allowed <= before) return std::max(1.0f, allowed / before * kFirstSize);
    float last = 0;
    for (int level = 1; level <= blocks.shape().top(); ++level) {
        const float size = static_cast<float>(1 << level);
        const float here = kShareOfBound * blocks.bound(block, level) * cellsPerValue + kShare * size;
        if (allowed < here) return size / 2 * sizeInLevel((allowed - before) / (here - before));
        last = here - before;
        before = here;
    }
    const float coarsest = static_cast<float>(1 << blocks.shape().top());
    return coarsest * (kFirstSize + (last > 0 ? (allowed - before) / last : 0));
}

/// Squared world distance, along one axis, from the eye to each block, in the units of `scale`.
std::vector<float> nearestSquares(const LevelSpace& space, const View& view, int axis, int blocks, int side,
                                  double scale) {
    const std::vector<double>& coordinate = space.coordinate[axis];
    const double eye = view.eye[axis] - space.levels[0].origin[axis];
    const auto last = static_cast<int>(coordinate.size()) - 1;
    std::vector<float> squares;
    for (int i = 0; i < blocks; ++i) {
        const auto [low, high] =
            std::minmax(coordinate[std::min(i * side, last)], coordinate[std::min((i + 1) * side, last)]);
        const double part = std::max({low - eye, eye - high, 0.0}) * view.worldPerUnit[axis] * scale;
        squares.push_back(static_cast<float>(part * part));
    }
    return squares;
}

glm::ivec3 cornerOf(int corner) {
    return {corner & 1, corner >> 1 & 1, corner >> 2};
}

/// Gradients below this are taken for it, so that displacements stay finite.
float leastGradient(const Blocks& blocks) {
    const ValueRange range = blocks.wholeRange();
    if (!(range.min <= range.max)) return std::numeric_limits<float>::min();
    return std::max(kLeastGradient * (range.max / 2 - range.min / 2), std::numeric_limits<float>::min());
}

/// Finds the blocks that may count, from the top.
class Finder {
  public:
    Finder(const Blocks& blocks, float iso, float least)
        : blocks_(blocks), iso_(iso), slack_(DetailError::kReach * least) {
        visit(blocks.shape().topReach(), glm::ivec3(0));
    }
    const std::vector<glm::ivec3>& found() const { return found_; }

  private:
    void visit(int up, glm::ivec3 cube) {
        const glm::ivec3 n = blocks_.shape().blocks();
        for (int k = 0; k < 3; ++k) {
            if (cube[k] << up >= n[k]) return;
        }
        const ValueRange reach = widened(blocks_.reach(up, cube));
        if (!(reach.min - slack_ <= iso_ && iso_ <= reach.max + slack_)) return;
        if (up == 0) {
            found_.push_back(cube);
            return;
        }
        for (int part = 0; part < 8; ++part) visit(up - 1, 2 * cube + cornerOf(part));
    }

    const Blocks& blocks_;
    const float iso_;
    const float slack_;
    std::vector<glm::ivec3> found_;
};

/// The size of each block of `found`; kUnlimited where it does not count.
std::vector<float> sizesOfBlocks(const LevelSpace& space, const View& view, const Blocks& blocks, float iso,
                                 const std::vector<glm::ivec3>& found, float least, int side, int threads) {
    const glm::ivec3 n = blocks.shape().blocks();
    double edge = 0;
    for (int k = 0; k < 3; ++k) edge = std::max(edge, space.largestStep[k] * std::abs(view.worldPerUnit[k]));
    const double cellsPerLength = view.errorPixels / (view.pixelsPerUnit * edge);
    std::array<std::vector<float>, 3> squares;
    for (int k = 0; k < 3; ++k) squares[k] = nearestSquares(space, view, k, n[k], side, cellsPerLength);
    std::vector<float> sizes(found.size(), kUnlimited);
    parallelFor(found.size(), kBlocksPerTask, threads, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const glm::ivec3 at = found[i];
            const std::size_t block = (static_cast<std::size_t>(at.z) * n.y + at.y) * n.x + at.x;
            const float gradient = std::max(blocks.gradient(block), least);
            const float weight = weightOf(blocks.range(block), iso, gradient);
            if (weight == 0) continue;
            const float allowed = std::sqrt(squares[0][at.x] + squares[1][at.y] + squares[2][at.z]);
            sizes[i] = sizeFor(blocks, block, weight / gradient, allowed);
        }
    });
    return sizes;
}

/// A corner has the smallest size of the blocks around it.
CornerGrid sizesAtCorners(glm::ivec3 blocks, const std::vector<glm::ivec3>& found,
                          const std::vector<float>& sizes) {
    CornerGrid corners(blocks + 1, kUnlimited);
    for (std::size_t i = 0; i < found.size(); ++i) {
        for (int corner = 0; corner < 8; ++corner) {
            float& value = corners.values[corners.place(found[i] + cornerOf(corner))];
            value = std::min(value, sizes[i]);
        }
    }
    return corners;
}

}  // namespace

ErrorSizes::ErrorSizes(const LevelSpace& space, const View& view, const TimedField& field, float iso,
                       float growthPerBrick, int threads) {
    const Blocks blocks(field);
    blockLevel_ = blocks.shape().blockLevel();
    side_ = kBrickSize << blockLevel_;
    const float least = leastGradient(blocks);
    const std::vector<glm::ivec3> found = Finder(blocks, iso, least).found();
    corners_ = sizesAtCorners(blocks.shape().blocks(), found,
                              sizesOfBlocks(space, view, blocks, iso, found, least, side_, threads));
    limitGrowth(corners_, growthPerBrick * static_cast<float>(1 << blockLevel_), threads);
    smallest_ = smallestInCubes(corners_, threads);
}

float ErrorSizes::at(glm::ivec3 index) const {
    const glm::ivec3 block = index / side_;
    const glm::ivec3 part = index - block * side_;
    std::array<std::ptrdiff_t, 3> stride = {1, corners_.dims.x,
                                            static_cast<std::ptrdiff_t>(corners_.dims.x) * corners_.dims.y};
    for (int k = 0; k < 3; ++k) {
        if (block[k] + 1 >= corners_.dims[k]) stride[k] = 0;
    }
    return between(&corners_.values[corners_.place(glm::min(block, corners_.dims - 1))], stride, part);
}

/// From the value at the first corner of a block, `part` cells on along each axis. `stride` leads to the next
/// corners, 0 where there is none.
float ErrorSizes::between(const float* corner, const std::array<std::ptrdiff_t, 3>& stride,
                          glm::ivec3 part) const {
    float value = *corner;
    // The way from the first corner of the block to its last one, the longest part first.
    std::array<int, 3> order = {0, 1, 2};
    if (part[order[0]] < part[order[1]]) std::swap(order[0], order[1]);
    if (part[order[1]] < part[order[2]]) std::swap(order[1], order[2]);
    if (part[order[0]] < part[order[1]]) std::swap(order[0], order[1]);
    const float share = 1.0f / static_cast<float>(side_);
    float before = value;
    for (int k = 0; k < 3 && part[order[k]] > 0; ++k) {
        corner += stride[order[k]];
        value += share * static_cast<float>(part[order[k]]) * (*corner - before);
        before = *corner;
    }
    return value;
}

void ErrorSizes::lower(int level, glm::ivec3 first, std::span<float> sizes) const {
    constexpr int kSide = kBrickSize + 1;
    struct Place {
        std::ptrdiff_t offset;  ///< of the block's first corner
        std::ptrdiff_t stride;
        int part;
    };
    std::array<std::array<Place, kSide>, 3> places;
    std::ptrdiff_t stride = 1;
    for (int k = 0; k < 3; ++k) {
        const int last = corners_.dims[k] - 1;
        for (int i = 0; i < kSide; ++i) {
            const int index = first[k] + (i << level);
            const int block = index / side_;
            places[k][i] = {std::min(block, last) * stride, block < last ? stride : 0, index - block * side_};
        }
        stride *= corners_.dims[k];
    }
    float* size = sizes.data();
    for (const Place& x : places[0]) {
        for (const Place& y : places[1]) {
            for (const Place& z : places[2]) {
                const float* const corner = corners_.values.data() + x.offset + y.offset + z.offset;
                *size = std::min(*size,
                                 between(corner, {x.stride, y.stride, z.stride}, {x.part, y.part, z.part}));
                ++size;
            }
        }
    }
}

float ErrorSizes::smallest(int level, glm::ivec3 first) const {
    if (level >= blockLevel_) {
        const int up = level - blockLevel_;
        const int last = static_cast<int>(smallest_.size()) - 1;
        return smallest_[std::min(up, last)].at(first / side_ >> up);
    }
    return inBlock(level, first, [](float a, float b) { return std::min(a, b); });
}

float ErrorSizes::largest(int level, glm::ivec3 first) const {
    if (level < blockLevel_) return inBlock(level, first, [](float a, float b) { return std::max(a, b); });
    const glm::ivec3 last = glm::min(corners_.dims - 1, first / side_ + (1 << (level - blockLevel_)));
    const glm::ivec3 begin = glm::min(first / side_, last);
    float value = 0;
    glm::ivec3 i;
    for (i.z = begin.z; i.z <= last.z; ++i.z)
        for (i.y = begin.y; i.y <= last.y; ++i.y)
            for (i.x = begin.x; i.x <= last.x; ++i.x)
                value = std::max(value, corners_.values[corners_.place(i)]);
    return value;
}

/// Sizes are linear in the tetrahedra of a part of a block, so smallest and largest at its corners.
template <typename Pick>
float ErrorSizes::inBlock(int level, glm::ivec3 first, Pick pick) const {
    float value = at(first);
    for (int corner = 1; corner < 8; ++corner)
        value = pick(value, at(first + cornerOf(corner) * (kBrickSize << level)));
    return value;
}

}  // namespace isoglass
