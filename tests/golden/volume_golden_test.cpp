#include "gl/headless_context.h"
#include "render/renderer.h"
#include "support/golden.h"
#include "volume/analytic.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace isoglass::test {
namespace {

/// As for the pictures of optics_golden_test.cpp.
constexpr ImageLimits kLimits{.threshold = 0.02, .mean = 2e-3, .changedShare = 0.005, .largest = 1};

/// 1 at the middle of two balls, less away from them.
float twoBalls(glm::dvec3 p, double) {
    const double left = glm::length(p - glm::dvec3(-0.35, 0, 0)),
                 right = glm::length(p - glm::dvec3(0.4, 0, 0.1));
    return static_cast<float>(std::max(1 - left / 0.7, 1 - right / 0.5));
}

/// Of rays that go through the volume, on even samples over [-1,1]^3.
class VolumeGolden : public testing::Test {
  protected:
    VolumeGolden() {
        frame_.camera = {.eye = {1.2, -4, 1.8}, .fovDegrees = 26, .size = {200, 120}};
        frame_.background = {0.02f, 0.03f, 0.05f};
        ShadedDraw& draw = frame_.shadedDraw.emplace();
        constexpr int kSamples = 49;
        const Lattice lattice = makeUnitLattice(kSamples);
        for (std::size_t k = 0; k < 3; ++k) draw.axes[k] = lattice.axes[k].coordinates;
        draw.first = renderer_.volumes().upload(
            makeVolumeSamples(glm::ivec3(kSamples), sampleField(lattice, twoBalls, 0)));
        draw.style = {
            .colors = {{0, {0.05f, 0.2f, 0.9f}}, {0.5, {0.1f, 0.8f, 0.7f}}, {0.8, {1, 0.3f, 0.05f}}},
            .opacities = {{0, 0}, {0.3, 0.1f}, {0.6, 0.2f}, {0.7, 0.95f}},
            .unit = 0.1};
    }

    void TearDown() override { context_.debugLog().throwIfAny("golden picture"); }

    void expectGolden(const std::string& name) {
        renderer_.render(frame_);
        EXPECT_EQ(differenceFromGolden(name, renderer_.readSrgb(), kLimits), "");
    }

    gl::HeadlessContext headless_;
    gl::Context& context_ = headless_.context();
    Renderer renderer_{context_};
    FrameDescription frame_{};
};

/// Two kernels, pale through their green and blue hulls, which let the background through at their rims; lit
/// from the eye, so darker towards the rims.
TEST_F(VolumeGolden, Lit) {
    expectGolden("volume-lit");
}

/// The same without light from the eye: even discs.
TEST_F(VolumeGolden, Emitting) {
    frame_.shadedDraw->style.lit = false;
    expectGolden("volume-emitting");
}

/// The front half is cut away: the kernels' orange insides lie open, with the brightest point in their
/// middles and dark where the gradient runs along the cut.
TEST_F(VolumeGolden, Cut) {
    frame_.shadedDraw->planes = {{0, 1, 0, 0}};
    expectGolden("volume-cut");
}

}  // namespace
}  // namespace isoglass::test
