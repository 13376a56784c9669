#include "volume/lattice.h"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

namespace isoglass {
namespace {

Axis makeAxis(std::vector<double> coordinates) {
    Axis axis;
    axis.coordinates = std::move(coordinates);
    return axis;
}

TEST(Axis, ClosingSampleOfAPeriodicAxisLiesOnePeriodFromTheFirst) {
    Axis axis = makeAxis({20, 110, 200, 290});
    EXPECT_EQ(axis.cells(), 3u);
    axis.period = 360;
    EXPECT_EQ(axis.cells(), 4u);
    EXPECT_EQ(axis.coordinate(3), 290);
    EXPECT_EQ(axis.coordinate(4), 380);
}

TEST(Axis, DescendingPeriodicAxisClosesDownwards) {
    Axis axis = makeAxis({290, 200, 110, 20});
    axis.period = 360;
    EXPECT_TRUE(axis.descending());
    EXPECT_EQ(axis.coordinate(4), -70);
}

TEST(Axis, OneSampleIsNotDescendingAndHasNoCellUnlessItRepeats) {
    Axis axis = makeAxis({7});
    EXPECT_FALSE(axis.descending());
    EXPECT_EQ(axis.cells(), 0u);
    axis.period = 2;
    EXPECT_EQ(axis.cells(), 1u);
    EXPECT_EQ(axis.coordinate(1), 9);
}

TEST(Lattice, DimsAndCellsFollowTheAxes) {
    Lattice lattice = makeUniformLattice({4, 5, 6}, glm::dvec3(0), glm::dvec3(1));
    lattice.axes[1].period = 5;
    EXPECT_EQ(lattice.dims(), glm::ivec3(4, 5, 6));
    EXPECT_EQ(lattice.cells(), glm::ivec3(3, 5, 5));
}

// A mirror is a mapping of negative determinant: an odd number of turned axes.
TEST(Lattice, IsMirroredByAnOddNumberOfDescendingAxes) {
    for (int descending = 0; descending < 8; ++descending) {
        const glm::dvec3 spacing(descending & 1 ? -1 : 1, descending & 2 ? -1 : 1, descending & 4 ? -1 : 1);
        const Lattice lattice = makeUniformLattice({3, 3, 3}, glm::dvec3(0), spacing);
        EXPECT_EQ(lattice.mirrored(), spacing.x * spacing.y * spacing.z < 0) << descending;
    }
}

TEST(Lattice, BoundsHoldEverySampleAndTheClosingOne) {
    Lattice lattice = makeUniformLattice({3, 4, 5}, {1, 2, 3}, {0.5, -2, 1});
    EXPECT_EQ(lattice.bounds()[0], glm::dvec3(1, -4, 3));
    EXPECT_EQ(lattice.bounds()[1], glm::dvec3(2, 2, 7));
    lattice.axes[0].period = 10;
    lattice.axes[1].period = 10;
    EXPECT_EQ(lattice.bounds()[0], glm::dvec3(1, -8, 3));
    EXPECT_EQ(lattice.bounds()[1], glm::dvec3(11, 2, 7));
}

TEST(Lattice, UniformCoordinatesAreMultiplesOfTheSpacing) {
    const Lattice lattice = makeUniformLattice({3, 1, 2}, {1, 5, -1}, {0.25, 3, 2});
    EXPECT_EQ(lattice.axes[0].coordinates, (std::vector<double>{1, 1.25, 1.5}));
    EXPECT_EQ(lattice.axes[1].coordinates, (std::vector<double>{5}));
    EXPECT_EQ(lattice.axes[2].coordinates, (std::vector<double>{-1, 1}));
    EXPECT_EQ(lattice.axes[2].name, "z");
}

}  // namespace
}  // namespace isoglass
