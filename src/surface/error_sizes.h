#pragma once

#include "surface/extract.h"
#include "surface/level_space.h"
#include "surface/view.h"

#include <glm/common.hpp>
#include <glm/vec3.hpp>

#include <cstddef>
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
/// An estimate, not a bound: where the gradient varies inside a block the surface may move farther.
/// Immutable; any number of threads may ask.
class ErrorSizes {
  public:
    /// `growthPerBrick` is the growth of the size along 8 level-0 cells at most.
    ErrorSizes(const LevelSpace& space, const View& view, const TimedField& field, float iso,
               float growthPerBrick, int threads);

    /// At a level-0 index, in units of the level-0 cell, at least 1.
    float at(glm::ivec3 index) const;
    /// Smallest and largest over the lattice vertices in the closed cube of 8 * 2^level cells from cell
    /// `first` on, a multiple of that.
    float smallest(int level, glm::ivec3 first) const;
    float largest(int level, glm::ivec3 first) const;

  private:
    /// Values by place, x fastest; beyond the end those at the nearest place.
    struct Grid {
        Grid() = default;
        explicit Grid(glm::ivec3 n);

        std::size_t place(glm::ivec3 i) const {
            return (static_cast<std::size_t>(i.z) * dims.y + i.y) * dims.x + i.x;
        }
        float at(glm::ivec3 i) const { return values[place(glm::min(i, dims - 1))]; }

        glm::ivec3 dims{0};
        std::vector<float> values;
    };

    void takeBlocks(glm::ivec3 blocks, const std::vector<float>& sizes);
    template <typename Pick>
    std::vector<Grid> picked(Pick pick) const;
    template <typename Pick>
    float inCube(const std::vector<Grid>& grids, int level, glm::ivec3 first, Pick pick) const;

    int side_ = 0;                ///< cells along a block
    int blockLevel_ = 0;          ///< 8 * 2^blockLevel_ of them
    Grid corners_;                ///< one more along each axis than blocks
    std::vector<Grid> smallest_;  ///< over the corners of the closed cubes of 2^i blocks a side
    std::vector<Grid> largest_;
};

}  // namespace isoglass
