#include "surface/error_sizes.h"

#include "mesh/mesh_check.h"
#include "support/mesh_distance.h"
#include "unit/levels/balance_check.h"
#include "unit/levels/level_case.h"
#include "volume/detail_error.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace isoglass {
namespace {

using test::Dice;
using test::Kind;
using test::LevelCase;

LevelCase errorCase(std::uint32_t seed, Kind kind, glm::ivec3 dims, double errorPixels) {
    LevelCase c = test::makeLevelCase(seed, kind, dims);
    c.options.view->cellPixels = 0;
    c.options.view->errorPixels = errorPixels;
    return c;
}

SizeField sizesOf(const LevelCase& c, const LevelSpace& space, const View& view) {
    return {space, view, c.field, c.options.iso, 1};
}

TEST(ErrorSizes, GrowNoFasterThanLevelsCan) {
    for (std::uint32_t seed = 0; seed < 10; ++seed) {
        const auto kind = static_cast<Kind>(seed % test::kKinds);
        const LevelCase c = errorCase(seed, kind, {70, 57, 64}, 1 << seed % 6);
        const LevelSpace space(c.lattice);
        test::expectBalanced(space, sizesOf(c, space, *c.options.view));
    }
}

/// Largest difference of the sizes at every fourth vertex, in units of the size.
double largestChange(const LevelSpace& space, const SizeField& a, const SizeField& b) {
    double largest = 0;
    glm::ivec3 i;
    for (i.z = 0; i.z <= space.cells.z; i.z += 4)
        for (i.y = 0; i.y <= space.cells.y; i.y += 4)
            for (i.x = 0; i.x <= space.cells.x; i.x += 4)
                largest = std::max<double>(largest, std::abs(a.at(i) / b.at(i) - 1));
    return largest;
}

/// Changes of the sizes over a part of a path and over the thousandth of it where they change most.
struct Changes {
    double coarse = 0;
    double fine = 0;
};

/// `sizesAt(t)` for t from 0 to 1. Halves the path again and again and keeps the half with the larger change:
/// a jump stays in it whole.
template <typename SizesAt>
Changes changesAlong(const LevelSpace& space, const SizesAt& sizesAt) {
    double low = 0;
    double high = 1;
    const auto change = [&](double from, double to) {
        return largestChange(space, sizesAt(from), sizesAt(to));
    };
    Changes changes{change(low, high), 0};
    while (high - low > 1e-3) {
        const double middle = 0.5 * (low + high);
        const double first = change(low, middle);
        const double second = change(middle, high);
        (first > second ? high : low) = middle;
        changes.fine = std::max(first, second);
        // A path that goes up and down changes more inside than from end to end.
        if (high - low > 0.1) changes.coarse = std::max(changes.coarse, changes.fine);
    }
    return changes;
}

// Sizes are piecewise smooth in eye and time, so that over a thousandth of a path they change by about as
// much less, or by up to a hundred times that where the path is steepest. A jump would stay.
void expectContinuous(const Changes& changes) {
    // Sizes are floats, computed in about ten roundings, of numbers that a level's difference magnifies by
    // 1 / kErrorPerCell at most.
    constexpr double kRounding = 10 * 0x1p-24 / kErrorPerCell;
    EXPECT_LE(changes.fine, 0.1 * changes.coarse + kRounding);
}

// So many bricks that a block is two of them a side.
TEST(ErrorSizes, OfLargeBlocksGrowNoFasterEither) {
    const Lattice lattice = makeUnitLattice(400);
    const TimedField field{makeSparseBlobs(lattice, 0, 0.05f), makeSparseBlobs(lattice, 0.1, 0.05f), 0.3f};
    ASSERT_EQ(field.a->detailError().blockLevel(), 1);
    View view{.eye = {1.2, 2, 0.5}, .pixelsPerUnit = 1000, .errorPixels = 1.5};
    const LevelSpace space(lattice);
    const SizeField sizes(space, view, field, 0.5f, 0);
    test::expectBalanced(space, sizes);
    const Extraction extraction = extractSurface(lattice, field, {.iso = 0.5f, .view = view});
    EXPECT_LT(extraction.mesh.triangleCount(),
              extractSurface(lattice, field, {.iso = 0.5f}).mesh.triangleCount() / 2);
    const MeshTopology topology = checkTopology(extraction.mesh);
    EXPECT_TRUE(topology.isOrientedManifold());
}

TEST(SizeField, OfABrickIsThatOfItsVertices) {
    for (std::uint32_t seed = 0; seed < 6; ++seed) {
        LevelCase c = errorCase(seed, Kind::blobs, {61, 57, 64}, 20);
        if (seed % 2 == 1)
            c.samples[0][30 * 61 * 57 + 20 * 61 + 11] = std::numeric_limits<float>::quiet_NaN();
        test::rebuild(c);
        const LevelSpace space(c.lattice);
        const SizeField sizes(space, *c.options.view, c.field, c.options.iso, 1);
        std::array<float, kBrickCorners> inBrick;
        for (const LevelBrick node : {LevelBrick{0, {3, 2, 1}}, LevelBrick{1, {1, 1, 1}},
                                      LevelBrick{3, {0, 0, 0}}, LevelBrick{0, {7, 7, 7}}}) {
            sizes.inBrick(node, inBrick);
            for (int place = 0; place < kBrickCorners; ++place) {
                const glm::ivec3 v(place / 81, place / 9 % 9, place % 9);
                ASSERT_EQ(inBrick[place], sizes.at((node.brick * kBrickSize + v) * (1 << node.level)));
            }
        }
    }
}

TEST(ErrorSizes, AreContinuousInTheEye) {
    for (const Kind kind : {Kind::blobs, Kind::gyroid, Kind::rough}) {
        const LevelCase c = errorCase(3, kind, {65, 57, 61}, 8);
        const LevelSpace space(c.lattice);
        Dice dice(5);
        double seen = 0;
        for (int trial = 0; trial < 6; ++trial) {
            glm::dvec3 eye;
            glm::dvec3 direction;
            for (int k = 0; k < 3; ++k) {
                eye[k] = dice.between(-60, 120);
                direction[k] = dice.between(-1, 1);
            }
            const Changes changes = changesAlong(space, [&](double t) {
                View view = *c.options.view;
                view.eye = eye + t * glm::normalize(direction);
                return sizesOf(c, space, view);
            });
            expectContinuous(changes);
            seen = std::max(seen, changes.coarse);
        }
        EXPECT_GT(seen, 1e-3);
    }
}

// Inside intervals and across a key frame: what an interval says of its end is what the next says of its
// start.
TEST(ErrorSizes, AreContinuousInTime) {
    for (const Kind kind : {Kind::blobs, Kind::gyroid, Kind::rough}) {
        LevelCase c = errorCase(7, kind, {65, 57, 61}, 1);
        c.options.view->eye = {-50, 20, 90};
        LevelCase next = c;
        next.samples = {c.samples[1], c.samples[0]};
        test::rebuild(next);
        const LevelSpace space(c.lattice);
        // From 0 to 2: the key frame between the intervals is at 1.
        const auto at = [&](double time) {
            LevelCase& which = time <= 1 ? c : next;
            which.field.fraction = static_cast<float>(time <= 1 ? time : time - 1);
            return sizesOf(which, space, *which.options.view);
        };
        double seen = 0;
        for (const double start : {0.0, 0.3, 0.6, 0.85, 1.2}) {
            const Changes changes = changesAlong(space, [&](double t) { return at(start + 0.3 * t); });
            expectContinuous(changes);
            seen = std::max(seen, changes.coarse);
        }
        EXPECT_GT(seen, 1e-3);
        const SizeField before = at(1);
        next.field.fraction = 0;
        EXPECT_EQ(largestChange(space, before, sizesOf(next, space, *next.options.view)), 0);
    }
}

TEST(ErrorSizes, NoiseStaysAtFullResolution) {
    LevelCase c = errorCase(11, Kind::noise, {41, 41, 41}, 0.5);
    c.options.view->eye = {-300, 20, 20};
    ExtractOptions finest = c.options;
    finest.view = View{.cellPixels = 1e-6};
    const SurfaceMesh mesh = extractSurface(c.lattice, c.field, c.options).mesh;
    EXPECT_EQ(mesh.triangles, extractSurface(c.lattice, c.field, finest).mesh.triangles);
    EXPECT_FALSE(mesh.empty());
}

// A smooth field keeps the word, and is cheaper for it.
TEST(ErrorSizes, SmoothSurfacesStayWithinTheError) {
    LevelCase c = errorCase(13, Kind::blobs, {121, 121, 121}, 0.5);
    c.field.fraction = 0.3f;
    c.options.iso = 0.5f;
    c.options.insideIsBelow = false;
    View& view = *c.options.view;
    view.pixelsPerUnit = 700;
    view.eye = {60, -400, 150};
    ExtractOptions finest = c.options;
    finest.view.reset();
    const SurfaceMesh full = extractSurface(c.lattice, c.field, finest).mesh;
    for (const double error : {0.25, 0.5, 1.0, 2.0}) {
        view.errorPixels = error;
        const SurfaceMesh mesh = extractSurface(c.lattice, c.field, c.options).mesh;
        std::vector<double> pixels;
        const auto add = [&](const SurfaceMesh& from, const SurfaceMesh& to) {
            const test::MeshDistance distance(to, 4);
            for (const glm::vec3& position : from.positions)
                pixels.push_back(distance.at(position, 16) * view.pixelsPerUnit /
                                 glm::length(view.eye - glm::dvec3(position)));
        };
        add(mesh, full);
        add(full, mesh);
        std::ranges::sort(pixels);
        EXPECT_LE(pixels[pixels.size() * 999 / 1000], error);
        std::printf("%g pixels: %zu triangles of %zu, 99.9 %% within %.3f\n", error, mesh.triangleCount(),
                    full.triangleCount(), pixels[pixels.size() * 999 / 1000]);
        if (error >= 2) {
            EXPECT_LT(3 * mesh.triangleCount(), full.triangleCount());
        }
    }
}

}  // namespace
}  // namespace isoglass
