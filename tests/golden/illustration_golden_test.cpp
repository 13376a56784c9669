#include "gl/headless_context.h"
#include "render/renderer.h"
#include "support/golden.h"
#include "surface/extract.h"
#include "volume/analytic.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>

namespace isoglass::test {
namespace {

/// As for silhouettes in layers_golden_test.cpp: all is rim, of which a fiftieth may change.
constexpr ImageLimits kLimits{.threshold = 0.02, .mean = 2e-3, .changedShare = 0.02, .largest = 1};

/// A rounded block with a bore through it from left to right and a smaller one from front to back, which do
/// not meet.
float block(glm::dvec3 p, double) {
    const glm::dvec3 beyond = glm::max(glm::abs(p) - glm::dvec3(0.55, 0.4, 0.5), glm::dvec3(0));
    const double body = 0.15 - glm::length(beyond);
    const double across = glm::length(glm::dvec2(p.y, p.z - 0.2)) - 0.2;
    const double through = glm::length(glm::dvec2(p.x + 0.3, p.z + 0.3)) - 0.12;
    return static_cast<float>(std::min({body, across, through}));
}

/// In the bore across.
float ball(glm::dvec3 p, double) {
    return static_cast<float>(0.17 - glm::length(p - glm::dvec3(0.1, 0, 0.2)));
}

class IllustrationGolden : public testing::Test {
  protected:
    IllustrationGolden() {
        frame_.camera = {.eye = {2.6, -4, 2.2}, .fovDegrees = 26, .size = {240, 180}};
        frame_.illustration.emplace();
        frame_.samples = 4;
        add(block, {});
    }

    void TearDown() override { context_.debugLog().throwIfAny("golden picture"); }

    void add(float (*field)(glm::dvec3, double), SurfaceDraw draw) {
        const Lattice lattice = makeUnitLattice(65);
        draw.mesh = renderer_.meshes().upload(
            extractSurface(lattice, {makeAnalyticFrame(lattice, field, 0), nullptr, 0}, {.iso = 0}).mesh);
        frame_.draws.push_back(draw);
    }

    void expectGolden(const std::string& name) {
        renderer_.render(frame_);
        EXPECT_EQ(differenceFromGolden(name, renderer_.readSrgb(), kLimits), "");
    }

    gl::HeadlessContext headless_;
    gl::Context& context_ = headless_.context();
    Renderer renderer_{context_};
    FrameDescription frame_{};
};

/// The block in black, hatched more densely towards the right, away from the light; in red the bores as they run
/// behind the front, where they open a black rim, and the far edges of the block.
TEST_F(IllustrationGolden, HiddenBores) {
    expectGolden("illustration-bores");
}

/// The same with a blue ball in the larger bore, very pale, for it lies behind the front and the wall of the bore.
TEST_F(IllustrationGolden, SecondaryGeometry) {
    add(ball, {.color = {0.02f, 0.1f, 0.7f}, .secondary = true});
    expectGolden("illustration-secondary");
}

/// Brown on white: coarse strokes, turned by 45 degrees, cross on the top, run alone on the right side, which is lit
/// best, and leave nothing free on the front, where no light falls; through the bores light sides are seen. The
/// second surface is drawn in the colour of the paper.
TEST_F(IllustrationGolden, OtherParameters) {
    frame_.illustration = {.depthThreshold = 12,
                           .normalThreshold = 3.9f,
                           .hatchAngle = 45,
                           .hatchSize = 7,
                           .hatchCross = 0.6f,
                           .light = {0.8f, 0.2f, 0.5f},
                           .paper = {1, 1, 1},
                           .front = {0.15f, 0.06f, 0.02f},
                           .back = {1, 1, 1}};
    expectGolden("illustration-parameters");
}

}  // namespace
}  // namespace isoglass::test
