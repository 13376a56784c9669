#include "gl/headless_context.h"
#include "render/renderer.h"
#include "support/golden.h"
#include "surface/extract.h"
#include "volume/analytic.h"

#include <glm/ext/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <cstdlib>

namespace isoglass::test {
namespace {

using enum TransparencyMethod;

/// 160 x 120 pixels of 8 bits. A step of 8 bits is at most 0.9 % of linear light, so two steps are below
/// the threshold. Other drivers place silhouettes a little differently: these pictures have about 700 such
/// pixels (4 %), and of each at most one sample in four flips; the share allows a quarter of them to
/// change, the mean that each of those changes by 0.1.
constexpr ImageLimits kLimits{.threshold = 0.02, .mean = 1e-3, .changedShare = 0.01, .largest = 1};

/// Blobs in two shells, a sphere through them in two more, and an opaque one in the middle.
class MethodsGolden : public testing::Test {
  protected:
    gl::HeadlessContext context_;
    Renderer renderer_{context_.context()};
    FrameDescription frame_{.camera = {.eye = {2.4, -3.2, 1.8}, .fovDegrees = 27, .size = {160, 120}},
                            .background = {0.5f, 0.55f, 0.6f},
                            .samples = 4,
                            .keepLinear = false};

    void SetUp() override {
        const glm::dmat4 second = glm::scale(
            glm::rotate(glm::translate(glm::dmat4(1), glm::dvec3(0.3, 0.1, 0)), 0.5, glm::dvec3(1, 2, 0)),
            glm::dvec3(1.2, 0.8, 0.8));
        add(blobs, 0.2f, {.color = {0.1f, 0.25f, 0.9f}, .opacity = 0.35f});
        add(blobs, 0.5f, {.color = {0.1f, 0.7f, 0.2f}, .opacity = 0.5f});
        add(growingSphere, 0.2f, {.worldFromSeries = second, .color = {0.9f, 0.6f, 0.05f}, .opacity = 0.4f});
        add(growingSphere, 0.6f, {.worldFromSeries = second, .color = {0.9f, 0.1f, 0.05f}});
    }

    void TearDown() override { context_.context().debugLog().throwIfAny("golden picture"); }

    void add(const AnalyticField& field, float iso, SurfaceDraw draw) {
        const Lattice lattice = makeUnitLattice(48);
        const TimedField timed{makeAnalyticFrame(lattice, field, 0), nullptr, 0};
        draw.mesh = renderer_.meshes().upload(extractSurface(lattice, timed, {.iso = iso}).mesh);
        frame_.draws.push_back(draw);
    }

    void expectGolden(const std::string& name, TransparencyMethod method, bool reproducible = false) {
        frame_.method = method;
        frame_.reproducible = reproducible;
        renderer_.render(frame_);
        EXPECT_EQ(differenceFromGolden(name, renderer_.readSrgb(), kLimits), "");
    }
};

TEST_F(MethodsGolden, TwoPass) {
    expectGolden("method-2-pass", twoPass);
}

TEST_F(MethodsGolden, ThreePass) {
    expectGolden("method-3-pass", threePass);
}

TEST_F(MethodsGolden, FourPass) {
    expectGolden("method-4-pass", fourPass);
}

TEST_F(MethodsGolden, PeelTwoLayers) {
    frame_.layers = 2;
    expectGolden("method-peel-2", peel);
}

TEST_F(MethodsGolden, Exact) {
    expectGolden("method-exact", exact);
}

/// The reproducible forms show the same pictures.
TEST_F(MethodsGolden, InIntegers) {
    if (std::getenv("ISOGLASS_UPDATE_GOLDEN") != nullptr)
        GTEST_SKIP() << "the float forms write the pictures";
    expectGolden("method-3-pass", threePass, true);
    expectGolden("method-4-pass", fourPass, true);
    frame_.layers = 2;
    expectGolden("method-peel-2", peel, true);
}

/// 16 samples: a supersampled picture four times, with shifted samples.
TEST_F(MethodsGolden, ManySamples) {
    frame_.samples = 16;
    expectGolden("method-exact-16-samples", exact);
}

}  // namespace
}  // namespace isoglass::test
