#include "mesh/mesh_check.h"
#include "support/mesh_distance.h"
#include "surface/cell_form.h"
#include "unit/levels/level_case.h"
#include "unit/levels/triangle_set.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

namespace isoglass {
namespace {

using test::Dice;
using test::Kind;
using test::LevelCase;

LevelCase blobsCase(int samples, double cellsPerSize) {
    LevelCase c = test::makeLevelCase(7, Kind::blobs, glm::ivec3(samples));
    c.field.fraction = 0.5f;
    c.options.iso = 0.4f;
    c.options.insideIsBelow = false;
    c.form = CellForm::sliding;
    c.gate = 0;
    c.options.view->cellPixels = c.options.view->pixelsPerUnit / cellsPerSize;
    return c;
}

SurfaceMesh meshFrom(LevelCase& c, glm::dvec3 eye) {
    c.options.view->eye = eye;
    return test::meshOf(c);
}

TEST(CellForms, WhereEverythingIsFineTheMeshIsThatOfFullResolution) {
    for (const Kind kind : {Kind::blobs, Kind::noise, Kind::integers}) {
        for (const bool below : {false, true}) {
            LevelCase c = test::makeLevelCase(3, kind, {33, 26, 40});
            c.options = {.iso = 0.5f, .insideIsBelow = below, .view = View{.cellPixels = 1e-6}, .threads = 1};
            c.form = CellForm::sliding;
            c.gate = 0;
            const SurfaceMesh detailed = test::meshOf(c);
            c.options.view.reset();
            const SurfaceMesh full = extractSurface(c.lattice, c.field, c.options).mesh;
            ASSERT_GT(full.triangleCount(), 0u);
            EXPECT_EQ(detailed.vertexCount(), full.vertexCount());
            EXPECT_TRUE(test::trianglesOf(detailed) == test::trianglesOf(full));
        }
    }
}

TEST(CellForms, CompactCellsNeedAThirdOfTheTriangles) {
    LevelCase c = blobsCase(65, 1e6);
    c.form = CellForm::tetrahedral;
    const auto tetrahedral = static_cast<double>(meshFrom(c, glm::dvec3(0)).triangleCount());
    c.form = CellForm::sliding;
    const auto sliding = static_cast<double>(meshFrom(c, glm::dvec3(0)).triangleCount());
    c.gate = 0.03f;
    const auto gated = static_cast<double>(meshFrom(c, glm::dvec3(0)).triangleCount());
    std::printf("triangles against tetrahedra: slide %.3f, slide and gates %.3f\n", sliding / tetrahedral,
                gated / tetrahedral);
    // A plane crosses 7 kinds of lattice edges, three of them axis edges; the counts of vertices and thus
    // of triangles are in the ratio of their projections: about 1 : 3 (method of the lattice crossings).
    EXPECT_LT(sliding, 0.36 * tetrahedral);
    EXPECT_LT(gated, 0.5 * tetrahedral);
}

// Between 1.85 and 1.9 cells of allowed size, and above where levels begin, cells change their form.
TEST(CellForms, SlideMovesTheSurfaceNoFasterThanTheEye) {
    LevelCase c = blobsCase(49, 100);
    Dice dice(8);
    for (const double step : {1.0, 0.1, 0.01, 0.001}) {
        double largest = 0;
        bool changed = false;
        for (const double ratio : {1.87, 2.2}) {
            // The lattice lies where the size ratio passes a slide.
            glm::dvec3 direction(dice.between(-1, 1), dice.between(-1, 1), dice.between(-1, 1));
            direction = glm::normalize(direction);
            const glm::dvec3 eye = glm::dvec3(24) + ratio * 100 * direction;
            const SurfaceMesh before = meshFrom(c, eye);
            const SurfaceMesh after = meshFrom(c, eye + step * direction);
            largest = std::max(largest, test::surfaceDistance(before, after, 2, 8));
            changed |= test::trianglesOf(before) != test::trianglesOf(after);
        }
        std::printf("step %g: surface moves by %.3g cells\n", step, largest);
        EXPECT_TRUE(changed);
        // A slide is over within 0.05 cells of size, 5 cells of the eye's way, and leads a vertex no
        // farther than half a cell of level 1.
        EXPECT_LE(largest, step / 5 + 1e-6);
    }
}

// As the iso-value passes a sample, ambiguous faces and fans change at once, unless gates make them slide.
TEST(CellForms, GatesKeepTheSurfaceStillWhereTheIsoValuePassesASample) {
    for (const Kind kind : {Kind::blobs, Kind::noise}) {
        LevelCase c = test::makeLevelCase(5, kind, {17, 17, 17});
        c.field.fraction = 0;
        c.options = {.view = View{.cellPixels = 1e-6}, .threads = 1};
        c.form = CellForm::sliding;
        std::vector<float> isoValues;
        for (const float sample : c.samples[0]) {
            if (sample > 0.45f && sample < 0.55f) isoValues.push_back(sample);
        }
        std::ranges::sort(isoValues);
        double gated = 0;
        double ungated = 0;
        for (std::size_t i = 0; i < isoValues.size(); i += isoValues.size() / 8 + 1) {
            for (const float gate : {0.0f, 0.1f}) {
                c.gate = gate;
                c.options.iso = isoValues[i];
                const SurfaceMesh at = test::meshOf(c);
                c.options.iso = std::nextafter(isoValues[i], 1.0f);
                const SurfaceMesh past = test::meshOf(c);
                double& largest = gate > 0 ? gated : ungated;
                largest = std::max(largest, test::surfaceDistance(at, past, 0.5, 8));
            }
        }
        std::printf("surface jumps by %.3g cells without gates, %.3g with\n", ungated, gated);
        EXPECT_LT(gated, 1e-3);
        EXPECT_GT(ungated, 1e-2);
    }
}

TEST(FormRamp, IsOneWhereLevelsTouchOrBlendAndZeroBetween) {
    for (const float growth : {0.05f, 0.14f, 0.5f, 0.99f}) {
        for (int level = 0; level <= 4; ++level) {
            const FormRamp ramp(level, 4, growth);
            float before = ramp.weight(1);
            for (float ratio = 1; ratio < 4; ratio += 0.001f) {
                const float weight = ramp.weight(ratio);
                // 0.05 a slide: 0.02 a step, and the rounding of the ratio.
                EXPECT_LE(std::abs(weight - before), 0.0201f) << level << " at " << ratio;
                before = weight;
                EXPECT_TRUE(weight == 1 || level == 4 || ratio < 1.9f);
                EXPECT_TRUE(weight == 1 || level == 0 || ratio > 1 + growth + 1.0f / 1024);
                EXPECT_EQ(ramp.isCompact(ratio, ratio), weight == 0);
            }
        }
        EXPECT_EQ(FormRamp(0, 4, growth).weight(1), 0);
    }
}

}  // namespace
}  // namespace isoglass
