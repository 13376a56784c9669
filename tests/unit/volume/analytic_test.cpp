#include "volume/analytic.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace isoglass {
namespace {

TEST(SparseBlobs, AreTheBlobsAboveTheFloor) {
    constexpr float kFloor = 0.05f;
    const Lattice lattice = makeUnitLattice(59);
    const auto frame = makeSparseBlobs(lattice, 0.1, kFloor);
    std::size_t above = 0;
    glm::ivec3 i;
    for (i.z = 0; i.z < 59; ++i.z) {
        for (i.y = 0; i.y < 59; ++i.y) {
            for (i.x = 0; i.x < 59; ++i.x) {
                const glm::dvec3 at(lattice.axes[0].coordinate(i.x), lattice.axes[1].coordinate(i.y),
                                    lattice.axes[2].coordinate(i.z));
                const float expected = std::max(blobs(at, 0.1), kFloor);
                above += expected > kFloor;
                // Sums of 8 products of 3 rounded factors: at most 13 roundings of what is below 4.
                ASSERT_NEAR(frame->sample(i), expected, 13 * 4 * 0x1p-24);
            }
        }
    }
    EXPECT_GT(above, 1000u);
}

TEST(SparseBlobs, TakeMemoryWhereTheBlobsAre) {
    const auto frame = makeSparseBlobs(makeUnitLattice(256), 0, 0.05f);
    std::size_t stored = 0;
    for (std::size_t i = 0; i < frame->brickCount(); ++i) stored += frame->brick(i).samples != nullptr;
    EXPECT_GT(stored, frame->brickCount() / 50);
    EXPECT_LT(stored, frame->brickCount() / 5);
    EXPECT_LT(frame->bytes(), 256u * 256 * 256 * 4 / 5 + frame->brickCount() * 24);
}

}  // namespace
}  // namespace isoglass
