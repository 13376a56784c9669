#include "mesh/mesh_check.h"
#include "support/mesh_distance.h"
#include "unit/levels/lattice_values.h"
#include "unit/levels/level_case.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cstdio>

namespace isoglass {
namespace {

using test::Dice;
using test::Kind;
using test::LatticeValues;
using test::LevelCase;

constexpr std::array<double, 4> kSteps = {1, 0.1, 0.01, 0.001};

struct Levels {
    LevelSpace space;
    SizeField sizes;
    LevelFields fields;

    Levels(const LevelCase& c, const View& view)
        : space(c.lattice),
          sizes(space, view, missingIn(c.field)),
          fields{space, sizes, fieldsOfLevels(space, c.field), 1} {}
    Levels(const Levels&) = delete;

    std::vector<LevelBrick> cut() const { return test::coverWithBricks(space, sizes); }
};

View seenFrom(const LevelCase& c, glm::dvec3 eye) {
    View view = *c.options.view;
    view.eye = eye;
    return view;
}

std::vector<LevelBrick> cutFrom(const LevelCase& c, glm::dvec3 eye) {
    return Levels(c, seenFrom(c, eye)).cut();
}

/// Two places of the eye, `step` apart, between which some brick changes its level.
std::array<glm::dvec3, 2> acrossASwitch(const LevelCase& c, double step, Dice& dice) {
    const glm::dvec3 cells = c.lattice.cells();
    for (;;) {
        glm::dvec3 a;
        glm::dvec3 direction;
        for (int k = 0; k < 3; ++k) {
            a[k] = 0.5 * cells[k] + dice.between(-1, 1) * cells.x;
            direction[k] = dice.between(-1, 1);
        }
        direction = glm::normalize(direction);
        double low = 0;
        double high = 4;
        const auto cut = cutFrom(c, a);
        if (cutFrom(c, a + high * direction) == cut) continue;
        while (high - low > step) {
            const double middle = 0.5 * (low + high);
            (cutFrom(c, a + middle * direction) == cut ? low : high) = middle;
        }
        return {a + low * direction, a + (low + step) * direction};
    }
}

/// Uneven steps between 0.8 and 1.2, so that positions blend.
LevelCase stretchedCase(Kind kind, std::uint32_t seed) {
    LevelCase c = test::makeLevelCase(seed, kind, {44, 37, 41});
    Dice dice(seed);
    for (Axis& axis : c.lattice.axes) {
        for (std::size_t i = 1; i < axis.size(); ++i)
            axis.coordinates[i] = axis.coordinates[i - 1] + dice.between(0.8, 1.2);
    }
    c.field.fraction = 0.3125f;
    c.options.view->cellPixels = c.options.view->pixelsPerUnit / 20;
    return c;
}

/// Size that a unit of length may add, in cells.
double sizePerLength(const LevelCase& c) {
    return c.options.view->cellPixels / c.options.view->pixelsPerUnit / 1.1;  // steps reach at least 1.1
}

double spread(const LevelCase& c) {
    float low = std::numeric_limits<float>::infinity();
    float high = -low;
    for (const auto& samples : c.samples) {
        for (const float value : samples) {
            low = std::min(low, value);
            high = std::max(high, value);
        }
    }
    return high - low;
}

/// The largest change of each channel that moving the eye by `step` may cause.
///
/// The weight of level l + 1 rises by 1 while the size grows by 0.1 * 2^l, so a step changes it by at most
/// 10 / 2^l * sizePerLength * step, and the channel by as much times the difference between the levels. Two
/// levels take part: 10 / 2^l + 10 / 2^(l+1) <= 15. Two levels differ by at most the spread R of the field;
/// gradients, being differences of at most R over steps of at least 0.8, by 2 R / 0.8; positions by half
/// the difference of two steps of their level, 0.2 * 2^l, and on the level above by twice that, in all
/// 15 * (0.2 + 0.4). Rounding: sizes are floats below 4 * 2^l, off by 2^-22 of themselves, which moves
/// weights by 10 * 4 * 2^-22.
LatticeValues::Values allowedChange(const LevelCase& c, double step) {
    const double weights = 15 * sizePerLength(c) * step + 1.5 * 10 * 4 * 0x1p-22;
    const double field = weights * spread(c);
    const double position = weights * 0.6;
    const double gradient = weights * 2 * spread(c) / 0.8;
    return {field, position, position, position, gradient, gradient, gradient};
}

TEST(LevelContinuity, LatticeChangesNoFasterThanTheEye) {
    for (const Kind kind : {Kind::blobs, Kind::noise}) {
        const LevelCase c = stretchedCase(kind, 11);
        Dice dice(12);
        for (const double step : kSteps) {
            LatticeValues::Values largest{};
            double jump = 0;
            for (int trial = 0; trial < 4; ++trial) {
                const auto eyes = acrossASwitch(c, step, dice);
                const Levels before(c, seenFrom(c, eyes[0]));
                const Levels after(c, seenFrom(c, eyes[1]));
                const auto change = test::largestChange(test::latticeValues(before.fields),
                                                        test::latticeValues(after.fields));
                for (std::size_t k = 0; k < change.size(); ++k) largest[k] = std::max(largest[k], change[k]);
                const auto unblended = test::largestChange(test::latticeValues(before.fields, false),
                                                           test::latticeValues(after.fields, false));
                jump = std::max(jump, unblended[0]);
            }
            const auto allowed = allowedChange(c, step);
            for (std::size_t k = 0; k < largest.size(); ++k)
                EXPECT_LE(largest[k], allowed[k]) << "channel " << k << ", step " << step;
            // The same measure sees levels that switch at once, however small the step.
            EXPECT_GT(jump, allowedChange(c, 0.01)[0]) << step;
            std::printf(
                "step %g: field %.3g (allowed %.3g), position %.3g (%.3g), gradient %.3g (%.3g), "
                "without blending %.3g\n",
                step, largest[0], allowed[0], std::max({largest[1], largest[2], largest[3]}), allowed[1],
                std::max({largest[4], largest[5], largest[6]}), allowed[4], jump);
        }
    }
}

TEST(LevelContinuity, BricksAgreeWhereTheyTouch) {
    for (const Kind kind : {Kind::blobs, Kind::noise, Kind::integers}) {
        const LevelCase c = stretchedCase(kind, 21);
        Dice dice(22);
        for (int trial = 0; trial < 3; ++trial) {
            const Levels levels(c, seenFrom(c, acrossASwitch(c, 0.1, dice)[0]));
            const LatticeValues values = test::latticeValues(levels.fields);
            // Means of floats are rounded once on each of two levels, half an ulp of values up to 2, or of
            // gradients up to 4; positions are doubles below 64.
            for (const std::size_t k : {0, 4, 5, 6}) EXPECT_LE(values.disagreement[k], 0x1p-21) << k;
            for (const std::size_t k : {1, 2, 3}) EXPECT_LE(values.disagreement[k], 0x1p-44) << k;
        }
    }
}

// At fixed sizes the blended field is a weighted mean of samples that are linear in time.
TEST(LevelContinuity, LatticeChangesNoFasterThanTheSamplesInTime) {
    for (const Kind kind : {Kind::blobs, Kind::noise}) {
        LevelCase c = stretchedCase(kind, 31);
        LevelCase next = c;
        next.samples = {c.samples[1], c.samples[0]};
        test::rebuild(next);
        double fastest = 0;
        for (std::size_t i = 0; i < c.samples[0].size(); ++i)
            fastest = std::max<double>(fastest, std::abs(c.samples[1][i] - c.samples[0][i]));
        for (const float step : {0.1f, 0.01f, 0.001f}) {
            const auto at = [&](LevelCase& which, float fraction) {
                which.field.fraction = fraction;
                return test::latticeValues(Levels(which, *which.options.view).fields);
            };
            const auto inside = test::largestChange(at(c, 0.5f), at(c, 0.5f + step));
            const auto across = test::largestChange(at(c, 1 - 0.5f * step), at(next, 0.5f * step));
            // A few roundings of values up to 2, half an ulp each.
            EXPECT_LE(inside[0], fastest * step + 0x1p-21);
            EXPECT_LE(across[0], fastest * step + 0x1p-21);
            EXPECT_LE(test::largestChange(at(c, 1), at(next, 0))[0], 0);
        }
    }
}

// The surface follows: its displacement is that of the field over the slope. Blobs have slopes of at least
// 0.1 a cell at these iso-values, so a change d of the field moves it by at most d / 0.1.
TEST(LevelContinuity, SurfaceMovesNoFasterThanTheEye) {
    LevelCase c = test::makeLevelCase(41, Kind::blobs, {49, 49, 49});
    c.field.fraction = 0.5f;
    c.options.iso = 0.4f;
    c.options.insideIsBelow = false;
    c.options.view->cellPixels = c.options.view->pixelsPerUnit / 20;
    Dice dice(42);
    double previous = std::numeric_limits<double>::infinity();
    for (const double step : kSteps) {
        double largest = 0;
        for (int trial = 0; trial < 2; ++trial) {
            const auto eyes = acrossASwitch(c, step, dice);
            std::array<SurfaceMesh, 2> meshes;
            for (int i = 0; i < 2; ++i) {
                ExtractOptions options = c.options;
                options.view = seenFrom(c, eyes[i]);
                meshes[i] = extractSurface(c.lattice, c.field, options).mesh;
            }
            largest = std::max(largest, test::surfaceDistance(meshes[0], meshes[1], 2, 8));
        }
        std::printf("step %g: surface moves by %.3g cells\n", step, largest);
        EXPECT_LT(largest, step);
        EXPECT_LT(largest, previous);
        previous = largest;
    }
}

TEST(MeshDistance, SeesAShiftAndAMissingPiece) {
    const LevelCase c = test::makeLevelCase(41, Kind::blobs, {33, 33, 33});
    ExtractOptions options = c.options;
    options.view.reset();
    options.iso = 0.4f;
    const SurfaceMesh mesh = extractSurface(c.lattice, c.field, options).mesh;
    // The rounding of doubles below 64, in a few operations.
    EXPECT_LE(test::surfaceDistance(mesh, mesh, 2, 8), 16 * 0x1p-47);
    SurfaceMesh moved = mesh;
    for (glm::vec3& position : moved.positions) position.z += 0.25f;
    const double distance = test::surfaceDistance(mesh, moved, 2, 8);
    // Where the surface is level a shift of 0.25 is a distance of nearly that, and nowhere of more.
    EXPECT_GT(distance, 0.2);
    EXPECT_LE(distance, 0.25 + 1e-6);
    SurfaceMesh half = mesh;
    half.triangles.resize(half.triangles.size() / 6 * 3);
    for (std::size_t i = 0; i < half.positions.size(); ++i)
        half.positions[i] = half.positions[half.triangles[0]];
    EXPECT_GT(test::surfaceDistance(mesh, half, 2, 8), 8);
}

}  // namespace
}  // namespace isoglass
