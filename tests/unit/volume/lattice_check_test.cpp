#include "volume/lattice_check.h"

#include "base/error.h"

#include <gtest/gtest.h>

#include <string>

namespace isoglass {
namespace {

std::string messageFor(const Lattice& lattice) {
    try {
        requireUsable(lattice, "storm.nc");
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

TEST(LatticeCheck, TakesWhatFloatsCanHold) {
    EXPECT_EQ(messageFor(makeUniformLattice({3, 3, 3}, glm::dvec3(-6.4e6), glm::dvec3(1e-3))), "");
    EXPECT_EQ(messageFor(makeUniformLattice({2, 2, 2}, glm::dvec3(0), glm::dvec3(kSmallestStep))), "");
    EXPECT_EQ(messageFor(makeUniformLattice({2, 2, 2}, glm::dvec3(0), glm::dvec3(kLargestCoordinate))), "");
}

TEST(LatticeCheck, NamesTheFirstCoordinateThatIsBeyond) {
    Lattice lattice = makeUniformLattice({3, 3, 3}, glm::dvec3(0), glm::dvec3(1));
    lattice.axes[1].coordinates = {0, 1, -1e31};
    EXPECT_EQ(messageFor(lattice),
              "the coordinate is beyond 1e30 (storm.nc, axis y, index 2); choose other units");
    lattice.axes[1].coordinates = {0, 1e-31, 1};
    EXPECT_EQ(messageFor(lattice),
              "the step to the coordinate is below 1e-30 (storm.nc, axis y, index 1); choose other units");
}

TEST(LatticeCheck, LooksAtTheSampleThatClosesAPeriodicAxis) {
    Lattice lattice = makeUniformLattice({3, 3, 3}, glm::dvec3(0), glm::dvec3(1));
    lattice.axes[2].period = 2e30;
    EXPECT_NE(messageFor(lattice).find("axis z, index 3"), std::string::npos);
}

}  // namespace
}  // namespace isoglass
