#pragma once

#include "surface/brick_field.h"
#include "surface/extract.h"
#include "surface/level_space.h"
#include "surface/size_field.h"

#include <glm/vec3.hpp>

#include <array>
#include <vector>

namespace isoglass {

/// Vertices along one side of a brick.
inline constexpr int kCornersPerSide = kBrickSize + 1;
inline constexpr int kBrickCorners = kCornersPerSide * kCornersPerSide * kCornersPerSide;

/// Place of vertex (x,y,z) of a brick, each 0 .. 8, in tables of kBrickCorners entries: z fastest.
constexpr int cornerPlace(int x, int y, int z) {
    return (x * kCornersPerSide + y) * kCornersPerSide + z;
}
constexpr int cornerPlace(glm::ivec3 v) {
    return cornerPlace(v.x, v.y, v.z);
}

/// Share of the next coarser level in the blended field at a vertex, from the ratio of its allowed size to
/// the cells of its own level: 0 up to 1.9, and 1 from 2 on, where cells of twice the size may begin.
float blendWeight(float sizeRatio);

/// Everything that is known at a vertex, blended over the levels.
struct Channels {
    glm::dvec3 position{0};  ///< world, relative to the mesh origin
    glm::vec3 gradient{0};   ///< world
};

/// The field of one extraction on all levels.
struct LevelFields {
    const LevelSpace& space;
    const SizeField& sizes;
    std::vector<TimedField> fields;  ///< one a level
    float sign = 1;                  ///< multiplies every value
};

/// Blended values on the 9^3 vertices of a brick of any level:
///
///     F_l(v) = f_l(v) + beta_l(v) (P[F_(l+1)](v) - f_l(v))
///
/// P takes the mean of the two vertices of the coarser lattice that v lies between. Sizes grow so slowly that
/// in a brick of level l only the levels l + 1 and l + 2 can take part. The same vertex of the same level has
/// the same bits in every brick that holds it, and where a brick touches one of twice the cell size,
/// F_l = P[F_(l+1)].
///
/// Working memory of one thread; `load` it for each brick.
class BlendedBrick {
  public:
    void load(const LevelFields& fields, LevelBrick node);

    LevelBrick node() const { return node_; }
    /// NaN where the sample is missing. By cornerPlace.
    const std::array<float, kBrickCorners>& values() const { return values_; }
    bool hasMissing() const { return hasMissing_; }
    /// Allowed size over the size of the brick's cells, at a vertex given by its place.
    float sizeRatio(int place) { return sizes()[place] / static_cast<float>(1 << node_.level); }
    /// Position and gradient at a vertex whose value is valid. Computed once.
    const Channels& channels(glm::ivec3 corner);

  private:
    static constexpr int kHalf = kBrickSize / 2 + 1;     // vertices a side on the next level
    static constexpr int kQuarter = kBrickSize / 4 + 1;  // and on the one after it

    void loadCoarser(const LevelFields& fields);
    const std::array<float, kBrickCorners>& sizes();
    glm::dvec3 position(glm::ivec3 corner) const;
    glm::vec3 gradient(glm::ivec3 corner) const;
    template <typename Value, typename OnLevel>
    Value blended(int levelsUp, glm::ivec3 local, const OnLevel& onLevel) const;
    glm::vec3 levelGradient(int levelsUp, glm::ivec3 local) const;

    const LevelFields* fields_ = nullptr;
    LevelBrick node_;
    bool hasMissing_ = false;
    int blendedLevels_ = 0;  ///< coarser levels that take part: 0, 1 or 2
    BrickField own_;
    BrickField scratch_;
    std::array<float, kBrickCorners> values_;
    std::array<float, kBrickCorners> sizes_;  ///< allowed ones; only where asked for
    bool sizesKnown_ = false;
    std::array<float, kBrickCorners> weights_;  ///< beta; only where blendedLevels_ > 0
    /// The next two levels with a border of one vertex, and the weights of the first of them.
    std::array<float, (kHalf + 2) * (kHalf + 2) * (kHalf + 2)> half_;
    std::array<float, (kQuarter + 2) * (kQuarter + 2) * (kQuarter + 2)> quarter_;
    std::array<float, kHalf * kHalf * kHalf> halfWeights_;

    std::array<Channels, kBrickCorners> channels_;
    std::array<std::uint32_t, kBrickCorners> channelsOf_{};  ///< the load that computed them
    std::uint32_t loads_ = 0;
};

}  // namespace isoglass
