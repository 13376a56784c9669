#include "volume/detail_error.h"

#include "unit/volume/series_fixture.h"
#include "volume/pyramid.h"

#include <glm/common.hpp>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <random>

namespace isoglass {
namespace {

/// The function of a level at a level-0 vertex: linear in the tetrahedra of its cells.
float prolonged(const KeyFrame& level, int number, glm::ivec3 index) {
    const int size = 1 << number;
    const glm::ivec3 part = index % size;
    glm::ivec3 corner = index / size;
    std::array<int, 3> order = {0, 1, 2};
    std::ranges::stable_sort(order, [&](int a, int b) { return part[a] > part[b]; });
    double sum = (size - part[order[0]]) * double(level.sample(corner));
    for (int k = 0; k < 3; ++k) {
        ++corner[order[k]];
        const int share = part[order[k]] - (k < 2 ? part[order[k + 1]] : 0);
        if (share > 0) sum += share * double(level.sample(glm::min(corner, level.dims() - 1)));
    }
    return static_cast<float>(sum / size);
}

std::shared_ptr<const KeyFrame> makeFrame(const Lattice& lattice, double holes, std::vector<float>& samples) {
    const glm::ivec3 dims = lattice.dims();
    std::mt19937 random(5);
    samples = randomFloats(dims, 3);
    for (float& sample : samples)
        if (random() * 0x1p-32 < holes) sample = std::numeric_limits<float>::quiet_NaN();
    return makeKeyFrame(lattice, samples);
}

struct Case {
    glm::ivec3 dims;
    bool periodic;
    double holes;
};

class DetailErrors : public testing::TestWithParam<Case> {};

// |f_0 - P^l f_l| <= sum of |f_k - P f_(k+1)|, each at most the largest of its level's vertices in the cells
// that the block touches.
TEST_P(DetailErrors, BoundWhatALevelLacks) {
    Lattice lattice = makeUniformLattice(GetParam().dims, glm::dvec3(0), glm::dvec3(1));
    if (GetParam().periodic) lattice.axes[0].period = GetParam().dims.x;
    std::vector<float> samples;
    const auto frame = makeFrame(lattice, GetParam().holes, samples);
    const DetailError& errors = frame->detailError();
    EXPECT_LE(errors.bytes(), DetailError::largestBytes(frame->cells()));
    ASSERT_EQ(errors.top(), frame->pyramid().top());
    const int side = kBrickSize << errors.blockLevel();
    glm::ivec3 i;
    std::size_t compared = 0;
    for (i.z = 0; i.z <= frame->cells().z; ++i.z) {
        for (i.y = 0; i.y <= frame->cells().y; ++i.y) {
            for (i.x = 0; i.x <= frame->cells().x; ++i.x) {
                const glm::ivec3 block = glm::min(i / side, errors.blocks() - 1);
                const std::size_t place =
                    (static_cast<std::size_t>(block.z) * errors.blocks().y + block.y) * errors.blocks().x +
                    block.x;
                glm::ivec3 stored = i;
                if (GetParam().periodic) stored.x %= GetParam().dims.x;
                const float here = frame->sample(stored);
                EXPECT_FALSE(here < errors.range(place).min || here > errors.range(place).max);
                EXPECT_EQ(errors.bound(place, 0), 0);
                for (int level = 1; level <= errors.top(); ++level) {
                    EXPECT_GE(errors.bound(place, level), errors.bound(place, level - 1));
                    const float lacks = std::abs(here - prolonged(*frame->pyramid().level(level), level, i));
                    if (std::isnan(lacks) || GetParam().holes > 0) continue;
                    // Values up to 1, a few roundings a level.
                    ASSERT_LE(lacks, errors.bound(place, level) + 8 * level * 0x1p-24f)
                        << level << " at " << i.x << ' ' << i.y << ' ' << i.z;
                    ++compared;
                }
            }
        }
    }
    EXPECT_TRUE(compared > 0 || GetParam().holes > 0 || errors.top() == 0);
}

INSTANTIATE_TEST_SUITE_P(Lattices, DetailErrors,
                         testing::Values(Case{{33, 33, 33}, false, 0}, Case{{40, 21, 70}, false, 0},
                                         Case{{36, 20, 19}, true, 0}, Case{{8, 5, 2}, false, 0},
                                         Case{{33, 20, 40}, false, 0.05}, Case{{130, 3, 9}, false, 0}));

TEST(DetailErrors, OfALinearFieldAreNothingAndItsGradientIsKnown) {
    const Lattice lattice = makeUniformLattice({33, 25, 17}, glm::dvec3(0), glm::dvec3(1));
    std::vector<float> samples;
    for (int z = 0; z < 17; ++z)
        for (int y = 0; y < 25; ++y)
            for (int x = 0; x < 33; ++x) samples.push_back(static_cast<float>(2 * x + 3 * y - 6 * z));
    const auto frame = makeKeyFrame(lattice, samples);
    const DetailError& errors = frame->detailError();
    // Small whole numbers: nothing is rounded but the root of 49 and sums of 7.
    EXPECT_EQ(errors.gradient(0), 7);
    EXPECT_EQ(errors.bound(0, 1), 0);
    EXPECT_EQ(errors.bound(0, 2), 0);
}

}  // namespace
}  // namespace isoglass
