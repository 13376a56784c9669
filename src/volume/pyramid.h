#pragma once

#include "volume/key_frame.h"
#include "volume/missing_distance.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <memory>
#include <vector>

namespace isoglass {

/// Coarser versions of one key frame, for surfaces with levels of detail.
///
/// Level l has the samples of level 0 at indices that are multiples of 2^l, and the last sample of each
/// axis where that is not one of them: outside the lattice the field has the value at the nearest index.
/// Subsampling keeps a sample what it is, so the range of a level's brick also bounds what is blended from
/// the levels above it, and levels and time commute. Level l spans ceil(cells / 2^l) cells; the top level
/// is the first that one brick spans. On levels above 0 a periodic axis is cut open: its closing sample
/// is stored.
///
/// Immutable.
class Pyramid {
  public:
    /// `base` is level 0 and must outlive the pyramid.
    explicit Pyramid(const KeyFrame& base);

    /// Number of the coarsest level; 0 where one brick spans the lattice.
    int top() const { return static_cast<int>(levels_.size()); }
    /// A level from 1 to `top()`.
    const std::shared_ptr<const KeyFrame>& level(int level) const { return levels_[level - 1]; }

    /// Hull of the level-0 ranges of all bricks of 8^3 cells inside brick `brick` of `level`: it bounds the
    /// field there on every level. Empty (min > max) where no sample is valid.
    ValueRange hull(int level, glm::ivec3 brick) const {
        const Hulls& hulls = hulls_[level];
        return hulls.ranges[(static_cast<std::size_t>(brick.z) * hulls.bricks.y + brick.y) * hulls.bricks.x +
                            brick.x];
    }

    const MissingDistance& missing() const { return missing_; }

    /// Memory beyond that of level 0.
    std::size_t bytes() const;
    /// No pyramid of a key frame of these dimensions, which itself takes `baseBytes`, takes more.
    static std::size_t largestBytes(glm::ivec3 dims, std::size_t baseBytes);

  private:
    struct Hulls {
        glm::ivec3 bricks;
        std::vector<ValueRange> ranges;
    };

    std::vector<std::shared_ptr<const KeyFrame>> levels_;
    std::vector<Hulls> hulls_;
    MissingDistance missing_;
};

/// Number of the coarsest level of a lattice with so many cells.
int topLevel(glm::ivec3 cells);

/// Where the samples of `level` are, so that the level can be used alone: the axis tables at the indices of
/// its samples. The last cell of an axis may be shorter than the others; a periodic axis is cut open.
Lattice coarseLattice(const Lattice& lattice, int level);

}  // namespace isoglass
