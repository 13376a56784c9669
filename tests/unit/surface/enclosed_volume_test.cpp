#include "surface/enclosed_volume.h"

#include "support/random_fields.h"
#include "unit/surface/surface_check.h"
#include "volume/analytic.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <numbers>

namespace isoglass {
namespace {

constexpr double kPi = std::numbers::pi;

EnclosedVolume volumeOf(const Lattice& lattice, std::span<const float> samples,
                        const ExtractOptions& options) {
    return enclosedVolume(lattice, {makeKeyFrame(lattice, samples), nullptr, 0}, options);
}

/// Volume of the unit cube where x + 2y + 3z <= t, by inclusion and exclusion of its corners.
double volumeBelow(double t) {
    double sum = 0;
    for (int corner = 0; corner < 8; ++corner) {
        const double at = (corner & 1) + 2 * (corner >> 1 & 1) + 3 * (corner >> 2);
        const double cube = std::pow(std::max(0.0, t - at), 3);
        sum += std::popcount(static_cast<unsigned>(corner)) % 2 ? -cube : cube;
    }
    return sum / (6 * 1 * 2 * 3);
}

/// Linear in every tetrahedron, so nothing is lost but the rounding of samples below 8 to floats, half of
/// 2^-21, which moves the plane by that over the gradient's length sqrt(14); its section of the cube is
/// smaller than 2.
TEST(EnclosedVolume, OfALinearFieldIsExact) {
    Lattice lattice = makeUniformLattice({5, 4, 9}, {0, 0, 0}, {0.25, 1.0 / 3, 0.125});
    lattice.axes[0].coordinates = {0, 0.1, 0.5, 0.7, 1};     // uneven
    lattice.axes[1].coordinates = {1, 2.0 / 3, 1.0 / 3, 0};  // descending
    const auto samples = sampleField(
        lattice, [](glm::dvec3 p, double) { return static_cast<float>(p.x + 2 * p.y + 3 * p.z); }, 0);
    for (const float iso : {-1.0f, 0.0f, 0.37f, 1.0f, 2.5f, 3.0f, 4.9f, 5.95f, 7.0f}) {
        const double tolerance = 2 * 0x1p-22 / std::sqrt(14) + 1e-12;
        EXPECT_NEAR(volumeOf(lattice, samples, {.iso = iso}).volume, 1 - volumeBelow(iso), tolerance) << iso;
        EXPECT_NEAR(volumeOf(lattice, samples, {.iso = iso, .insideIsBelow = true}).volume, volumeBelow(iso),
                    tolerance)
            << iso;
        EXPECT_NEAR(volumeOf(lattice, samples, {.iso = iso}).domain, 1, 1e-12);
    }
}

/// A distance d to a curve or point has second derivatives of at most 1/d. Linear interpolation in a Kuhn
/// tetrahedron, which lies in a ball of radius sqrt(3)/2 h, errs by at most half of that times the radius
/// squared, so the surface lies within this of the true one.
double displacementBound(double radius, double h) {
    return 3.0 / 8 * h * h / (radius - std::sqrt(3) * h);
}

TEST(EnclosedVolume, OfASphereIsWithinTheBoundOfInterpolation) {
    constexpr double kRadius = 0.6137;
    const auto field = [](glm::dvec3 p, double) {
        return static_cast<float>(kRadius - glm::length(p - glm::dvec3(0.1234, -0.0871, 0.0519)));
    };
    for (const int count : {17, 33, 65}) {
        const Lattice lattice = makeUnitLattice(count);
        const double displacement = displacementBound(kRadius, 2.0 / (count - 1));
        const double bound = 4 * kPi / 3 * (std::pow(kRadius + displacement, 3) - std::pow(kRadius, 3));
        EXPECT_NEAR(volumeOf(lattice, sampleField(lattice, field, 0), {.iso = 0}).volume,
                    4 * kPi / 3 * std::pow(kRadius, 3), bound)
            << count;
    }
}

TEST(EnclosedVolume, OfATorusIsWithinTheBoundOfInterpolation) {
    constexpr double kRing = 0.6, kTube = 0.28;
    const auto field = [](glm::dvec3 p, double) {
        return static_cast<float>(kTube - std::hypot(std::hypot(p.x, p.y) - kRing, p.z));
    };
    for (const int count : {33, 65}) {
        const Lattice lattice = makeUnitLattice(count);
        // Around the hole the distance bends with its distance from the axis, which is larger than the tube.
        const double displacement = displacementBound(kTube, 2.0 / (count - 1));
        const double bound = 2 * kPi * kPi * kRing * (std::pow(kTube + displacement, 2) - std::pow(kTube, 2));
        EXPECT_NEAR(volumeOf(lattice, sampleField(lattice, field, 0), {.iso = 0}).volume,
                    2 * kPi * kPi * kRing * kTube * kTube, bound)
            << count;
    }
}

/// What is not above is below; the sums have thousands of terms of relative error 2^-50 or less.
TEST(EnclosedVolume, AboveAndBelowFillTheDomain) {
    const glm::ivec3 dims(18, 9, 11);
    const Lattice lattice = makeUniformLattice(dims, {0, 0, 0}, {1, 2, 0.5});
    for (std::uint32_t seed = 0; seed < 8; ++seed) {
        auto samples = randomFloats(dims, seed);
        if (seed % 2) removeSamples(samples, 5, seed + 50);
        const EnclosedVolume above = volumeOf(lattice, samples, {.iso = 0.1234f});
        const EnclosedVolume below = volumeOf(lattice, samples, {.iso = 0.1234f, .insideIsBelow = true});
        EXPECT_NEAR(above.volume + below.volume, above.domain, above.domain * 1e-12);
        EXPECT_NEAR(above.domain, 17 * 8 * 10 - static_cast<double>(above.missingCells), 1e-9);
        EXPECT_EQ(above.missingCells > 0, seed % 2 == 1);
        EXPECT_GT(above.volume, 0);
        EXPECT_GT(below.volume, 0);
    }
}

TEST(EnclosedVolume, CyclicAxisHasOneMoreCell) {
    Lattice lattice = makeUniformLattice({8, 3, 3}, {0, 0, 0}, {45, 1, 1});
    lattice.axes[0].period = 360;
    const std::vector<float> samples(8 * 3 * 3, 1.0f);
    EXPECT_DOUBLE_EQ(volumeOf(lattice, samples, {.iso = 0.5f}).volume, 360 * 2 * 2);
}

/// Columns over a plane that slopes: the field is the height itself, so what lies below a level surface is
/// the part of the domain under a plane, and the heights are linear, so nothing is lost but rounding.
TEST(EnclosedVolume, FollowsHeights) {
    const glm::ivec3 dims(5, 4, 6);
    Lattice lattice = makeUniformLattice(dims, {0, 0, 0}, {1, 1, 1});
    lattice.heights = HeightField{"z", "m", 0, 20};
    std::vector<float> heights;
    for (int z = 0; z < dims.z; ++z) {
        for (int y = 0; y < dims.y; ++y) {
            for (int x = 0; x < dims.x; ++x)
                heights.push_back(0.5f * static_cast<float>(x) + 0.25f * static_cast<float>(y) +
                                  2 * static_cast<float>(z));
        }
    }
    const auto frame = makeKeyFrame(lattice, heights, heights);
    // The floor rises from 0 to 2.75, the ceiling is 10 above it: level 6 lies between them everywhere.
    const double floorMean = 0.5 * 2 + 0.25 * 1.5;
    const EnclosedVolume below =
        enclosedVolume(lattice, {frame, nullptr, 0}, {.iso = 6, .insideIsBelow = true});
    EXPECT_NEAR(below.volume, 4 * 3 * (6 - floorMean), 1e-9);
    EXPECT_NEAR(below.domain, 4 * 3 * 10, 1e-9);
}

TEST(EnclosedVolume, HasTheSameBitsForAnyNumberOfThreads) {
    const Lattice lattice = makeUnitLattice(40);
    const auto a = makeAnalyticFrame(lattice, blobs, 0);
    const auto b = makeAnalyticFrame(lattice, blobs, 0.3);
    const double one = enclosedVolume(lattice, {a, b, 0.4f}, {.iso = 0.5f, .threads = 1}).volume;
    for (const int threads : {2, 3, 7}) {
        const double more = enclosedVolume(lattice, {a, b, 0.4f}, {.iso = 0.5f, .threads = threads}).volume;
        EXPECT_EQ(std::bit_cast<std::uint64_t>(more), std::bit_cast<std::uint64_t>(one));
    }
}

}  // namespace
}  // namespace isoglass
