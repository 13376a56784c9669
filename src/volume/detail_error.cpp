#include "volume/detail_error.h"

#include "basis/parallel.h"
#include "volume/pyramid.h"

#include <glm/common.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace isoglass {

namespace {

constexpr std::size_t kMostBlocks = std::size_t{1} << 16;
constexpr std::size_t kBlocksPerTask = 64;
constexpr int kLargestBox = kBrickSize + 1;

glm::ivec3 blocksAt(glm::ivec3 cells, int blockLevel) {
    const int side = kBrickSize << blockLevel;
    return glm::max((cells + (side - 1)) / side, glm::ivec3(1));
}

std::size_t count(glm::ivec3 n) {
    return static_cast<std::size_t>(n.x) * n.y * n.z;
}

int blockLevelFor(glm::ivec3 cells) {
    int level = 0;
    while (count(blocksAt(cells, level)) > kMostBlocks) ++level;
    return level;
}

void include(ValueRange& range, ValueRange other) {
    range.min = std::min(range.min, other.min);
    range.max = std::max(range.max, other.max);
}

float valueIn(const BrickView& brick, int x, int y, int z) {
    if (brick.missing) return std::numeric_limits<float>::quiet_NaN();
    if (!brick.samples) return brick.constant;
    if (brick.valid && !(brick.valid[x] >> (y * kBrickSize + z) & 1))
        return std::numeric_limits<float>::quiet_NaN();
    return brick.samples[(x * kBrickSize + y) * kBrickSize + z];
}

/// n^3 samples of a level, z fastest; beyond the end those at the nearest index.
struct Box {
    void gather(const KeyFrame& frame, glm::ivec3 first, int size) {
        n = size;
        std::array<std::array<int, kLargestBox>, 3> index;
        for (int k = 0; k < 3; ++k) {
            const int cells = frame.cells()[k];
            for (int i = 0; i < n; ++i) {
                index[k][i] = std::clamp(first[k] + i, 0, cells);
                if (frame.periodic()[k]) index[k][i] %= cells;
            }
        }
        float* out = values.data();
        for (int x = 0; x < n; ++x) {
            for (int y = 0; y < n; ++y, out += n) gatherRow(frame, index[0][x], index[1][y], index[2], out);
        }
    }

    void gatherRow(const KeyFrame& frame, int x, int y, const std::array<int, kLargestBox>& z,
                   float* row) const {
        for (int i = 0; i < n;) {
            const int brickZ = z[i] / kBrickSize;
            const BrickView& brick = frame.brick(frame.linear({x / kBrickSize, y / kBrickSize, brickZ}));
            for (; i < n && z[i] / kBrickSize == brickZ; ++i)
                row[i] = valueIn(brick, x % kBrickSize, y % kBrickSize, z[i] % kBrickSize);
        }
    }

    /// Largest |f(v) - (f(v-p) + f(v+p)) / 2|, p the parity of v: what the next level lacks. The box begins
    /// at an even vertex. Missing samples do not count.
    float largestDetail() const {
        float largest = 0;
        for (int parity = 1; parity < 8; ++parity) {
            const glm::ivec3 p(parity & 1, parity >> 1 & 1, parity >> 2);
            const int reach = (p.x * n + p.y) * n + p.z;
            for (int x = p.x; x < n; x += 2) {
                for (int y = p.y; y < n; y += 2) {
                    for (int z = p.z; z < n; z += 2) {
                        const float* at = &values[(x * n + y) * n + z];
                        const float detail = std::abs(*at - 0.5f * (at[-reach] + at[reach]));
                        if (detail > largest) largest = detail;
                    }
                }
            }
        }
        return largest;
    }

    /// Mean length of the forward differences over the cells that have them; negative where none has.
    double meanGradient() const {
        double sum = 0;
        int cells = 0;
        for (int x = 0; x + 1 < n; ++x) {
            for (int y = 0; y + 1 < n; ++y) {
                for (int z = 0; z + 1 < n; ++z) {
                    const float* at = &values[(x * n + y) * n + z];
                    const float dx = at[n * n] - *at;
                    const float dy = at[n] - *at;
                    const float dz = at[1] - *at;
                    const float length = std::sqrt(dx * dx + dy * dy + dz * dz);
                    if (!(length <= std::numeric_limits<float>::max())) continue;
                    sum += length;
                    ++cells;
                }
            }
        }
        return cells > 0 ? sum / cells : -1;
    }

    int n = 0;
    std::array<float, kLargestBox * kLargestBox * kLargestBox> values;
};

}  // namespace

class DetailError::Builder {
  public:
    Builder(const KeyFrame& base, const Pyramid& pyramid, DetailError& result)
        : base_(base), pyramid_(pyramid), result_(result) {}

    void build(std::size_t block) {
        const glm::ivec3 n = result_.blocks_;
        const glm::ivec3 place(block % n.x, block / n.x % n.y, block / (static_cast<std::size_t>(n.x) * n.y));
        const int side = 1 << result_.blockLevel_;
        const glm::ivec3 bricks = (base_.cells() + (kBrickSize - 1)) / kBrickSize;
        const glm::ivec3 end = glm::min((place + 1) * side, bricks);
        ValueRange range;
        std::fill(details_.begin(), details_.end(), 0.0f);
        gradientSum_ = 0;
        gradientCount_ = 0;
        glm::ivec3 brick;
        for (brick.z = place.z * side; brick.z < end.z; ++brick.z) {
            for (brick.y = place.y * side; brick.y < end.y; ++brick.y) {
                for (brick.x = place.x * side; brick.x < end.x; ++brick.x) {
                    const ValueRange own = base_.range(base_.linear(brick));
                    include(range, own);
                    addBrick(brick, own.min < own.max);
                }
            }
        }
        result_.ranges_[block] = range;
        result_.gradients_[block] =
            gradientCount_ > 0 ? static_cast<float>(gradientSum_ / gradientCount_) : 0.0f;
        float sum = 0;
        for (int level = 0; level < result_.top_; ++level)
            result_.bounds_[block * result_.top_ + level] = sum += details_[level];
    }

  private:
    void addBrick(glm::ivec3 brick, bool varies) {
        if (varies) {
            box_.gather(base_, brick * kBrickSize, kBrickSize + 1);
            details_[0] = std::max(details_[0], box_.largestDetail());
            const double gradient = box_.meanGradient();
            if (gradient >= 0) {
                gradientSum_ += gradient;
                ++gradientCount_;
            }
        }
        // From level 3 on the cells of a level are no smaller than the brick; details lie at odd vertices, so
        // the pair of cells with an odd one between them is looked at.
        for (int level = 1; level < result_.top_; ++level) {
            const int cells = std::max(kBrickSize >> level, 2);
            const glm::ivec3 first = (brick * kBrickSize >> level) / cells * cells;
            box_.gather(*pyramid_.level(level), first, cells + 1);
            details_[level] = std::max(details_[level], box_.largestDetail());
        }
    }

    const KeyFrame& base_;
    const Pyramid& pyramid_;
    DetailError& result_;
    Box box_;
    std::array<float, 32> details_{};
    double gradientSum_ = 0;
    int gradientCount_ = 0;
};

DetailError::DetailError(const KeyFrame& base, const Pyramid& pyramid)
    : blockLevel_(blockLevelFor(base.cells())),
      top_(pyramid.top()),
      blocks_(blocksAt(base.cells(), blockLevel_)),
      ranges_(count(blocks_)),
      gradients_(count(blocks_)),
      bounds_(count(blocks_) * top_) {
    parallelFor(count(blocks_), kBlocksPerTask, 0, [&](std::size_t begin, std::size_t end) {
        Builder builder(base, pyramid, *this);
        for (std::size_t block = begin; block < end; ++block) builder.build(block);
    });
    for (const ValueRange& range : ranges_) include(wholeRange_, range);
    addReaches();
}

void DetailError::addReaches() {
    Reaches fine{blocks_, ranges_};
    for (std::size_t i = 0; i < ranges_.size(); ++i) {
        fine.ranges[i].min -= kReach * gradients_[i];
        fine.ranges[i].max += kReach * gradients_[i];
    }
    reaches_.push_back(std::move(fine));
    while (reaches_.back().dims != glm::ivec3(1)) {
        const glm::ivec3 dims = reaches_.back().dims;
        Reaches coarse{(dims + 1) / 2, std::vector<ValueRange>(count((dims + 1) / 2))};
        std::size_t place = 0;
        glm::ivec3 i;
        for (i.z = 0; i.z < dims.z; ++i.z) {
            for (i.y = 0; i.y < dims.y; ++i.y) {
                for (i.x = 0; i.x < dims.x; ++i.x, ++place) {
                    const glm::ivec3 to = i / 2;
                    include(
                        coarse
                            .ranges[(static_cast<std::size_t>(to.z) * coarse.dims.y + to.y) * coarse.dims.x +
                                    to.x],
                        reaches_.back().ranges[place]);
                }
            }
        }
        reaches_.push_back(std::move(coarse));
    }
}

std::size_t DetailError::bytes() const {
    std::size_t reaches = 0;
    for (const Reaches& level : reaches_) reaches += level.ranges.size() * sizeof(ValueRange);
    return reaches + ranges_.size() * sizeof(ValueRange) +
           (gradients_.size() + bounds_.size()) * sizeof(float);
}

std::size_t DetailError::largestBytes(glm::ivec3 cells) {
    const std::size_t perBlock = sizeof(ValueRange) + (1 + topLevel(cells)) * sizeof(float);
    glm::ivec3 blocks = blocksAt(cells, blockLevelFor(cells));
    std::size_t bytes = count(blocks) * (perBlock + sizeof(ValueRange));
    while (blocks != glm::ivec3(1)) {
        blocks = (blocks + 1) / 2;
        bytes += count(blocks) * sizeof(ValueRange);
    }
    return bytes;
}

}  // namespace isoglass
