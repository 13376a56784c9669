#pragma once

#include "volume/key_frame.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <vector>

namespace isoglass {

class Pyramid;

/// By how much the coarser levels of a key frame differ from it, block by block: what a surface made of
/// larger cells may be off by.
///
/// A block has 8 * 2^m cells a side, with the smallest m that gives at most 2^16 of them. Immutable.
class DetailError {
  public:
    /// `pyramid` is that of `base`. Uses all cores.
    DetailError(const KeyFrame& base, const Pyramid& pyramid);

    /// Cells along the side of a block are 8 * 2^blockLevel.
    int blockLevel() const { return blockLevel_; }
    /// Blocks along each axis; the last ones may reach beyond the domain.
    glm::ivec3 blocks() const { return blocks_; }
    /// Number of the coarsest level.
    int top() const { return top_; }

    /// Range of the field in the closed block; empty (min > max) where no sample is valid.
    ValueRange range(std::size_t block) const { return ranges_[block]; }
    /// Mean length of the gradient over the block's bricks that are not constant, per level-0 cell.
    float gradient(std::size_t block) const { return gradients_[block]; }
    /// Range of the field over all blocks; empty where no sample is valid.
    ValueRange wholeRange() const { return wholeRange_; }

    /// Hull, over the blocks in a cube of 2^`up` of them a side, of their ranges widened by `kReach`
    /// gradients at both ends: for other iso-values none of them matters. `cube` counts cubes of that size.
    ValueRange reach(int up, glm::ivec3 cube) const { return reaches_[up].at(cube); }
    /// One cube of 2^`topReach()` blocks a side holds all.
    int topReach() const { return static_cast<int>(reaches_.size()) - 1; }
    static constexpr float kReach = 2;

    /// Bound of the difference between the field and that of `level`, prolonged, at the level-0 vertices of
    /// the block: the sum over the levels below of what each takes away. 0 for level 0; grows with the level.
    float bound(std::size_t block, int level) const {
        return level == 0 ? 0 : bounds_[block * top_ + level - 1];
    }

    std::size_t bytes() const;
    /// No key frame with so many cells takes more.
    static std::size_t largestBytes(glm::ivec3 cells);

  private:
    class Builder;

    struct Reaches {
        ValueRange at(glm::ivec3 cube) const {
            return ranges[(static_cast<std::size_t>(cube.z) * dims.y + cube.y) * dims.x + cube.x];
        }
        glm::ivec3 dims;
        std::vector<ValueRange> ranges;
    };

    void addReaches();

    int blockLevel_ = 0;
    int top_ = 0;
    glm::ivec3 blocks_{0};
    std::vector<ValueRange> ranges_;
    std::vector<float> gradients_;
    std::vector<float> bounds_;  ///< top_ a block
    ValueRange wholeRange_;
    std::vector<Reaches> reaches_;  ///< by `up`
};

}  // namespace isoglass
