#include "gl/headless_context.h"
#include "render/renderer.h"
#include "support/golden.h"
#include "volume/analytic.h"

#include <glm/ext/matrix_transform.hpp>
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

/// A round hole, bored into the left kernel from the front, whose wall shows its pale hull above and its
/// orange inside below, dark where the gradient runs across the view; a ball is cut out of the right kernel,
/// so that its orange inside lies open, with its brightest point in the middle.
TEST_F(VolumeGolden, CutBySolids) {
    const glm::dmat4 bore =
        glm::rotate(glm::translate(glm::dmat4(1), {-0.25, -0.5, 0.05}), M_PI / 2, {1, 0, 0});
    frame_.shadedDraw->solids = {
        {SolidShape::cylinder, Keep::outside, glm::scale(bore, {0.2, 0.2, 0.6})},
        {SolidShape::sphere, Keep::outside,
         glm::scale(glm::translate(glm::dmat4(1), {0.55, -0.3, 0.3}), glm::dvec3(0.35))}};
    expectGolden("volume-cut-by-solids");
}

/// Both kernels lie open in the hollows that balls leave. With the light of cuts they are bright where they face the
/// eye, out to their rims, where the gradient alone would leave dark rings.
TEST_F(VolumeGolden, LitCuts) {
    for (const glm::dvec3& middle : {glm::dvec3(-0.35, -0.45, 0.2), glm::dvec3(0.45, -0.35, 0.25)}) {
        frame_.shadedDraw->solids.push_back(
            {SolidShape::sphere, Keep::outside,
             glm::scale(glm::translate(glm::dmat4(1), middle), glm::dvec3(0.4))});
    }
    frame_.shadedDraw->style.cut = CutLight{.thickness = 0.15, .weight = CutLight::Weight::smooth};
    expectGolden("volume-lit-cuts");
}

}  // namespace
}  // namespace isoglass::test
