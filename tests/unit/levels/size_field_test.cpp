#include "surface/size_field.h"

#include "unit/levels/lattice_values.h"
#include "unit/levels/level_case.h"

#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace isoglass {
namespace {

using test::Dice;

Lattice unevenLattice(glm::ivec3 dims, Dice& dice) {
    Lattice lattice = makeUniformLattice(dims, glm::dvec3(0), glm::dvec3(1));
    for (Axis& axis : lattice.axes) {
        for (std::size_t i = 1; i < axis.size(); ++i)
            axis.coordinates[i] = axis.coordinates[i - 1] + dice.between(0.3, 1.5);
    }
    return lattice;
}

/// A view that asks for more growth than is allowed in every third case.
View drawView(const Lattice& lattice, Dice& dice) {
    View view;
    view.pixelsPerUnit = 700;
    view.cellPixels = view.pixelsPerUnit / std::exp(dice.between(std::log(5.0), std::log(60.0)));
    view.worldPerUnit = {dice.between(0.2, 2), dice.between(0.2, 2), dice.between(0.2, 2)};
    for (int k = 0; k < 3; ++k) {
        const double cells = lattice.cells()[k];
        view.eye[k] = dice.between(-2, 3) * cells;
    }
    return view;
}

bool touch(LevelBrick a, LevelBrick b) {
    const glm::ivec3 firstA = a.brick * (1 << a.level);
    const glm::ivec3 firstB = b.brick * (1 << b.level);
    return glm::all(glm::lessThanEqual(firstA, firstB + (1 << b.level))) &&
           glm::all(glm::lessThanEqual(firstB, firstA + (1 << a.level)));
}

void expectBalanced(const LevelSpace& space, const SizeField& sizes) {
    const std::vector<LevelBrick> bricks = test::coverWithBricks(space, sizes);
    for (const LevelBrick& brick : bricks) {
        float low = 1e30f;
        float high = 0;
        glm::ivec3 v;
        for (v.z = 0; v.z <= kBrickSize; ++v.z) {
            for (v.y = 0; v.y <= kBrickSize; ++v.y) {
                for (v.x = 0; v.x <= kBrickSize; ++v.x) {
                    const float size = sizes.at((brick.brick * kBrickSize + v) * (1 << brick.level));
                    low = std::min(low, size);
                    high = std::max(high, size);
                }
            }
        }
        const float cell = static_cast<float>(1 << brick.level);
        EXPECT_GE(low, cell);
        EXPECT_TRUE(high < 4 * cell || brick.level == space.top()) << high;
        // Bounds hold for every vertex, bit by bit but for the rounding of a mean near missing samples.
        EXPECT_LE(sizes.smallest(brick), low * 1.000001f);
        EXPECT_GE(sizes.largestByDistance(brick), high);
        EXPECT_LE(high - low, sizes.growthPerBrick() * cell * 1.00001f);
    }
    for (std::size_t i = 0; i < bricks.size(); ++i) {
        for (std::size_t j = i + 1; j < bricks.size(); ++j) {
            const bool apart = std::abs(bricks[i].level - bricks[j].level) > 1;
            EXPECT_FALSE(apart && touch(bricks[i], bricks[j]));
        }
    }
}

TEST(SizeField, GrowsNoFasterThanLevelsCan) {
    for (std::uint32_t seed = 0; seed < 12; ++seed) {
        Dice dice(seed);
        const Lattice lattice = unevenLattice({70, 57, 64}, dice);
        const LevelSpace space(lattice);
        expectBalanced(space, SizeField(space, drawView(lattice, dice)));
    }
}

TEST(SizeField, IsOneBesideMissingSamplesAndGrowsFromThere) {
    for (std::uint32_t seed = 20; seed < 26; ++seed) {
        Dice dice(seed);
        const Lattice lattice = unevenLattice({120, 40, 48}, dice);
        std::vector<float> samples(static_cast<std::size_t>(120) * 40 * 48, 1.0f);
        const std::size_t hole = dice.below(static_cast<std::uint32_t>(samples.size()));
        samples[hole] = std::numeric_limits<float>::quiet_NaN();
        const auto frame = makeKeyFrame(lattice, samples);
        const LevelSpace space(lattice);
        View view = drawView(lattice, dice);
        view.eye.x = 1e5;  // all else would be coarse
        const SizeField sizes(space, view, {&frame->pyramid().missing()});
        expectBalanced(space, sizes);
        const glm::ivec3 at(hole % 120, hole / 120 % 40, hole / (120 * 40));
        EXPECT_EQ(sizes.at(at), 1);
        EXPECT_EQ(sizes.at(glm::min(at + 1, space.cells)), 1);
        EXPECT_GT(sizes.at({at.x < 60 ? 119 : 0, 20, 20}), 2);
    }
}

TEST(SizeField, IsTheSizeOnTheScreen) {
    const Lattice lattice = makeUniformLattice({65, 65, 65}, glm::dvec3(0), glm::dvec3(2));
    const LevelSpace space(lattice);
    View view;
    view.eye = {-120, 64, 64};
    view.pixelsPerUnit = 500;
    view.cellPixels = 10;
    const SizeField sizes(space, view);
    // 10 pixels at a distance of 248 are 10 / 500 * 248 = 4.96 units, cells of 2 units.
    EXPECT_FLOAT_EQ(sizes.at({64, 32, 32}), 2.48f);
    EXPECT_TRUE(sizes.isCoarseEnough({0, {0, 0, 0}}));
    EXPECT_FALSE(sizes.isCoarseEnough({1, {0, 2, 2}}));
    EXPECT_TRUE(sizes.isCoarseEnough({1, {3, 2, 2}}));
    // Nearer than 100 units a cell of 2 takes more than 10 pixels already.
    view.eye = {-50, 64, 64};
    EXPECT_EQ(SizeField(space, view).at({0, 32, 32}), 1);
}

}  // namespace
}  // namespace isoglass
