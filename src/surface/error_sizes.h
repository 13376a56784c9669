#pragma once

#include "surface/corner_grid.h"
#include "surface/extract.h"
#include "surface/level_space.h"
#include "surface/view.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace isoglass {

/// Cells no smaller than this share of what the eye can tell apart (`View::errorPixels`) are of no use: the
/// error metric alone would let them grow without end where no surface is.
inline constexpr double kErrorPerCell = 0.002;

/// The cell sizes that keep a surface within `View::errorPixels` of where it belongs, at the corners of
/// blocks of the lattice.
///
/// In a block whose field reaches the iso-value cells of level l displace the surface by about
/// e_l = bound_l / (2 gradient) + 0.002 * 2^l level-0 cells. The size grows with what `errorPixels` are at
/// the block's nearest point: 1.3 * 2^l where they are e_l, slowly in between while the cells stay those of
/// level l, quickly before e_(l+1), because changes of level take three times the triangles. Bounds, gradient
/// and range are linear in time between key frames, and blocks count less the farther their range is from the
/// iso-value, so that sizes are continuous in eye and time. A corner takes the smallest of its blocks, and
/// sizes grow no faster than levels may; in between they are linear in the six tetrahedra of a block that go
/// from its first corner to its last.
///
/// Blocks that do not count are passed over in the octree, so that what a moment costs follows the surface,
/// but for a few passes over the corners, of which there are at most about 2^16.
///
/// An estimate, not a bound: where the gradient varies inside a block the surface may move farther.
/// Immutable; any number of threads may ask.
class ErrorSizes {
  public:
    /// `growthPerBrick` is the growth of the size along 8 level-0 cells at most.
    ErrorSizes(const LevelSpace& space, const View& view, const TimedField& field, float iso,
               float growthPerBrick, int threads);

    /// At a level-0 index, in units of the level-0 cell, at least 1.
    float at(glm::ivec3 index) const;
    /// Lowers sizes of vertices to these, bit by bit those of `at`: 9^3 vertices, z fastest, from level-0
    /// index `first` on, 2^level apart.
    void lower(int level, glm::ivec3 first, std::span<float> sizes) const;
    /// Smallest and largest over the lattice vertices in the closed cube of 8 * 2^level cells from cell
    /// `first` on, a multiple of that.
    float smallest(int level, glm::ivec3 first) const;
    float largest(int level, glm::ivec3 first) const;

  private:
    float between(const float* corner, const std::array<std::ptrdiff_t, 3>& stride, glm::ivec3 part) const;
    template <typename Pick>
    float inBlock(int level, glm::ivec3 first, Pick pick) const;

    int side_ = 0;                      ///< cells along a block
    int blockLevel_ = 0;                ///< 8 * 2^blockLevel_ of them
    CornerGrid corners_;                ///< one more along each axis than blocks
    std::vector<CornerGrid> smallest_;  ///< over the corners of the closed cubes of 2^i blocks a side
};

}  // namespace isoglass
