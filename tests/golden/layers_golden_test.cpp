#include "gl/headless_context.h"
#include "render/renderer.h"
#include "support/golden.h"
#include "surface/extract.h"
#include "volume/analytic.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cmath>

namespace isoglass::test {
namespace {

/// As for the pictures of optics_golden_test.cpp; silhouettes are all rim, of which a fiftieth may change.
constexpr ImageLimits kLimits{.threshold = 0.02, .mean = 2e-3, .changedShare = 0.02, .largest = 1};

/// A thick shell with a round hole, and a small ball in its middle.
float shells(glm::dvec3 p, double) {
    const double shell = 0.12 - std::abs(glm::length(p) - 0.65);
    const double beside = glm::length(p - glm::dvec3(0.5, -0.45, 0.2)) - 0.3;
    const double ball = 0.25 - glm::length(p - glm::dvec3(-0.1, 0.1, 0));
    return static_cast<float>(std::max(std::min(shell, beside), ball));
}

class LayersGolden : public testing::Test {
  protected:
    LayersGolden() {
        frame_.camera = {.eye = {2.4, -3.2, 1.8}, .fovDegrees = 26, .size = {160, 120}};
        frame_.background = {0.5f, 0.55f, 0.6f};
        frame_.samples = 4;
        LayerDraw& draw = frame_.layerDraw.emplace();
        constexpr int kSamples = 49;
        const Lattice lattice = makeUnitLattice(kSamples);
        for (std::size_t k = 0; k < 3; ++k) draw.axes[k] = lattice.axes[k].coordinates;
        draw.first = renderer_.volumes().upload(
            makeVolumeSamples(glm::ivec3(kSamples), sampleField(lattice, shells, 0)));
        draw.color = {0.9f, 0.45f, 0.15f};
        draw.style.colors = {
            {0.9f, 0.25f, 0.1f}, {0.95f, 0.7f, 0.2f}, {0.2f, 0.7f, 0.9f}, {0.3f, 0.3f, 0.9f}};
    }

    void TearDown() override { context_.debugLog().throwIfAny("golden picture"); }

    void expectGolden(const std::string& name) {
        renderer_.render(frame_);
        EXPECT_EQ(differenceFromGolden(name, renderer_.readSrgb(), kLimits), "");
    }

    LayerStyle& style() { return frame_.layerDraw->style; }

    gl::HeadlessContext headless_;
    gl::Context& context_ = headless_.context();
    Renderer renderer_{context_};
    FrameDescription frame_{};
};

/// The outside, with its hole: through it the ball in the middle and the far wall of the shell.
TEST_F(LayersGolden, First) {
    style().show = LayerStyle::Show::nth;
    style().count = 1;
    expectGolden("layers-first");
}

/// The inner side of the shell behind the outside, a disc of it where the ray leaves the shell into the
/// hollow; through the hole the back of the ball and of the far wall.
TEST_F(LayersGolden, Second) {
    style().show = LayerStyle::Show::nth;
    style().count = 2;
    expectGolden("layers-second");
}

/// All of that, the outside red, the next layer yellow, the ball behind both blue.
TEST_F(LayersGolden, Composed) {
    style().count = 4;
    style().opacities = {0.35f, 0.35f, 0.9f, 0.5f};
    expectGolden("layers-composed");
}

TEST_F(LayersGolden, Blend) {
    style().show = LayerStyle::Show::blend;
    expectGolden("layers-blend");
}

/// Black where the outside, and what shows through the hole, are seen edge-on; grey the rim of the hollow,
/// lighter that of the ball behind it.
TEST_F(LayersGolden, Silhouettes) {
    frame_.background = glm::vec3(1);
    style() = {.show = LayerStyle::Show::silhouettes, .count = 4, .silhouette = 0.3};
    expectGolden("layers-silhouettes");
}

/// The half beyond x = 0.1 is gone: the cut shows no wall of its own, behind it lie the inner sides. The
/// opaque ball hides what is behind it and shines through where it is inside.
TEST_F(LayersGolden, CutWithAnOpaqueBall) {
    style().count = 4;
    style().opacities = {0.5f};
    frame_.layerDraw->planes = {{-1, 0, 0, 0.1}};
    const auto ball = [](glm::dvec3 p, double) {
        return static_cast<float>(0.3 - glm::length(p - glm::dvec3(-0.3, -0.6, 0)));
    };
    const Lattice lattice = makeUnitLattice(40);
    const TimedField field{makeAnalyticFrame(lattice, ball, 0), nullptr, 0};
    frame_.draws.push_back(
        {.mesh = renderer_.meshes().upload(extractSurface(lattice, field, {.iso = 0}).mesh),
         .color = {0.2f, 0.6f, 0.2f}});
    expectGolden("layers-cut");
}

}  // namespace
}  // namespace isoglass::test
