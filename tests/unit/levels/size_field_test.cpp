#include "surface/size_field.h"

#include "unit/levels/balance_check.h"
#include "unit/levels/level_case.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace isoglass {
namespace {

using test::Dice;
using test::expectBalanced;

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
