#include "base/error.h"
#include "render_fixture.h"
#include "support/ground_truth.h"
#include "support/image_compare.h"

#include <glm/ext/matrix_transform.hpp>

#include <algorithm>
#include <random>

namespace isoglass::test {
namespace {

using enum TransparencyMethod;

const glm::vec3 kBackground(0.2f, 0.25f, 0.3f);

/// A way to compose: a method, or its reproducible form.
struct Way {
    const char* name;
    TransparencyMethod method;
    int layers = 4;
    bool reproducible = false;
};

const Way kWays[] = {{"twoPass", twoPass},
                     {"threePass", threePass},
                     {"fourPass", fourPass},
                     {"peelOne", peel, 1},
                     {"peelFour", peel, 4},
                     {"exact", exact},
                     {"threePassInIntegers", threePass, 4, true},
                     {"fourPassInIntegers", fourPass, 4, true},
                     {"peelFromLists", peel, 3, true}};

std::vector<TruthSurface> nestedSpheres() {
    return {{sphere({0, 0, 0}, 0.9f, 16), {.color = {0.1f, 0.3f, 0.9f}, .opacity = 0.3f}},
            {sphere({0.05f, 0, 0}, 0.7f, 16), {.color = {0.1f, 0.8f, 0.2f}, .opacity = 0.4f}},
            {sphere({0, 0.1f, 0}, 0.45f, 16), {.color = {0.9f, 0.7f, 0.1f}, .opacity = 0.5f}},
            {sphere({0, 0.1f, -0.1f}, 0.2f, 16), {.color = {0.8f, 0.1f, 0.1f}, .opacity = 1}}};
}

/// Two volumes of two surfaces each, the second one turned and stretched, that cut through each other.
std::vector<TruthSurface> twoVolumes() {
    glm::dmat4 second = glm::translate(glm::dmat4(1), glm::dvec3(0.5, 0.2, -0.1));
    second = glm::scale(glm::rotate(second, 0.7, glm::dvec3(1, 2, 3)), glm::dvec3(1.4, 0.7, 1));
    std::vector<TruthSurface> surfaces = nestedSpheres();
    surfaces.resize(2);
    for (int i = 0; i < 2; ++i) {
        surfaces.push_back(surfaces[static_cast<std::size_t>(i)]);
        surfaces.back().draw.worldFromSeries = second;
        surfaces.back().draw.color = glm::vec3(0.9f, 0.4f, 0.1f) * (1 - 0.3f * static_cast<float>(i));
    }
    return surfaces;
}

/// Half shells: their edges are boundaries, and back faces show without a front face before them.
std::vector<TruthSurface> openSurfaces() {
    std::vector<TruthSurface> surfaces = nestedSpheres();
    for (TruthSurface& surface : surfaces) {
        auto& triangles = surface.mesh.triangles;
        triangles.resize(triangles.size() / 6 * 3);
        surface.draw.worldFromSeries = glm::rotate(glm::dmat4(1), 1.0, glm::dvec3(1, 0.3, 0.2));
    }
    return surfaces;
}

/// 64 squares that fill the view, nearest last, so that the order of draws is the wrong one for lists.
std::vector<TruthSurface> stack64(float opacity) {
    std::vector<TruthSurface> surfaces;
    for (int i = 0; i < 64; ++i) {
        const float share = static_cast<float>(i) / 63;
        surfaces.push_back({quad(-1 + 0.03f * static_cast<float>((i * 37) % 64), 8, i % 3 == 2),
                            {.color = {share, 1 - share, 0.5f}, .opacity = opacity}});
    }
    return surfaces;
}

class Methods : public RenderTest, public testing::WithParamInterface<Way> {
  protected:
    FrameDescription frame_{.camera = {.eye = {3, 2, 2.5}, .fovDegrees = 34, .size = {64, 48}},
                            .background = kBackground,
                            .method = GetParam().method,
                            .layers = GetParam().layers,
                            .reproducible = GetParam().reproducible};

    /// 1e-3 is what the methods promise in linear light; a silhouette sample may flip, so those pixels are
    /// counted and bounded by `mostSilhouettes` of the picture.
    void expectTruth(const std::vector<TruthSurface>& surfaces, double mostSilhouettes) {
        show(frame_, surfaces);
        const TruthImage truth = renderTruth(frame_, surfaces, composerOf(frame_));
        const double share = double(truth.silhouettePixels()) / double(truth.color.pixels.size());
        EXPECT_LE(share, mostSilhouettes);
        const LinearImage image = renderLinear(frame_);
        EXPECT_EQ(differenceBeyond(
                      {.threshold = 1e-3, .mean = share + 1e-3, .changedShare = share, .largest = 1e-3},
                      GetParam().name, image, truth.color, truth.silhouette),
                  "");
        RecordProperty("silhouettes", static_cast<int>(truth.silhouettePixels()));
    }
};

TEST_P(Methods, NestedSpheresMatchTheGroundTruth) {
    expectTruth(nestedSpheres(), 0.05);
}

TEST_P(Methods, TwoIntersectingVolumesMatchTheGroundTruth) {
    expectTruth(twoVolumes(), 0.08);
}

TEST_P(Methods, OpenSurfacesMatchTheGroundTruth) {
    expectTruth(openSurfaces(), 0.05);
}

TEST_P(Methods, FromInsideASurfaceTheyMatchTheGroundTruth) {
    frame_.camera.eye = {0.3, 0.2, 0.45};
    frame_.camera.fovDegrees = 70;
    expectTruth(nestedSpheres(), 0.05);
}

TEST_P(Methods, SixtyFourLayersMatchTheGroundTruth) {
    frame_.camera = fromAbove(10, {16, 12});
    frame_.lighting = kUnlit;
    expectTruth(stack64(0.05f), 0);
}

/// Nothing overflows, is negative or no number; opacity 1 is opaque: the nearest one is all there is.
TEST_P(Methods, SixtyFourLayersOfAnyOpacityStayNumbers) {
    for (const float opacity : {0.01f, 0.5f, 0.999f, 1.0f}) {
        frame_.camera = fromAbove(10, {16, 12});
        frame_.lighting = kUnlit;
        frame_.draws.clear();
        const std::vector<TruthSurface> surfaces = stack64(opacity);
        show(frame_, surfaces);
        const TruthImage truth = renderTruth(frame_, surfaces, composerOf(frame_));
        const LinearImage image = renderLinear(frame_);
        for (std::size_t i = 0; i < image.pixels.size(); ++i) {
            for (int c = 0; c < 3; ++c) {
                const float value = image.pixels[i][c];
                ASSERT_TRUE(std::isfinite(value) && value >= 0) << opacity;
                // 64 roundings of 2^-24 relative to the sum, and as many quanta of 2^-24; the logarithm
                // of the integer form is good for 2^-20.
                ASSERT_NEAR(value, truth.color.pixels[i][c], 1e-4 * std::max(1.0f, truth.color.pixels[i][c]))
                    << opacity;
            }
        }
        EXPECT_EQ(renderer_.plan().runs(PassKind::opaque), opacity == 1);
    }
}

INSTANTIATE_TEST_SUITE_P(Ways, Methods, testing::ValuesIn(kWays),
                         [](const auto& way) { return std::string(way.param.name); });

class Lists : public RenderTest {
  protected:
    FrameDescription frame_{.camera = {.eye = {3, 2, 2.5}, .fovDegrees = 34, .size = {64, 48}},
                            .background = kBackground,
                            .method = exact};
};

/// Two identical volumes: every fragment has a twin at its very depth, and both count.
TEST_F(Lists, CoincidentSurfacesLoseNoLayer) {
    std::vector<TruthSurface> surfaces = nestedSpheres();
    const std::vector<TruthSurface> twins = surfaces;
    surfaces.insert(surfaces.end(), twins.begin(), twins.end());
    show(frame_, surfaces);
    const TruthImage truth = renderTruth(frame_, surfaces, composerOf(frame_));
    EXPECT_GE(truth.deepest, 12u);
    const double share = double(truth.silhouettePixels()) / double(truth.color.pixels.size());
    EXPECT_LE(share, 0.05);
    EXPECT_EQ(
        differenceBeyond({.threshold = 1e-3, .mean = share + 1e-3, .changedShare = share, .largest = 1e-3},
                         "twins", renderLinear(frame_), truth.color, truth.silhouette),
        "");
}

/// Coincident layers of different colors: some order is taken, and it is the same for any order of draws.
TEST_F(Lists, TiesHaveAnOrderThatDrawsDoNotChange) {
    frame_.camera = fromAbove(10, {16, 12});
    frame_.lighting = kUnlit;
    std::vector<TruthSurface> surfaces;
    for (int i = 0; i < 20; ++i) {
        const float share = static_cast<float>(i) / 19;
        surfaces.push_back({quad(i < 12 ? 0.0f : 0.5f, 8),
                            {.color = {share, 1 - share, 0.3f}, .opacity = 0.1f + 0.02f * share}});
    }
    show(frame_, surfaces);
    const LinearImage first = renderLinear(frame_);
    // The product of transmittances knows no order: it shows that no layer is lost.
    double transmittance = 1;
    for (const TruthSurface& surface : surfaces) transmittance *= 1 - double(surface.draw.opacity);
    std::mt19937 random(7);
    for (int trial = 0; trial < 20; ++trial) {
        std::shuffle(frame_.draws.begin(), frame_.draws.end(), random);
        ASSERT_EQ(renderLinear(frame_).pixels, first.pixels);
    }
    FrameDescription dark = frame_;
    for (SurfaceDraw& draw : dark.draws) draw.color = glm::vec3(0);
    // 20 products, each rounded by 2^-24.
    EXPECT_NEAR(renderLinear(dark).at(8, 6).b, transmittance * double(kBackground.b), 20 * 0x1p-24);
}

/// Memory for a few nodes only: the picture comes in strips down to single pixels, with the same bits.
TEST_F(Lists, ThatDoNotFitTheMemoryGiveTheSameBits) {
    for (const int samples : {1, 4}) {
        frame_.samples = samples;
        frame_.draws.clear();
        show(frame_, twoVolumes());
        const LinearImage whole = renderLinear(frame_);
        for (const std::size_t nodes : {40000u, 4000u, 500u, 60u}) {
            renderer_.setListMemory(FragmentLists::kHeaderBytes + nodes * FragmentLists::kNodeBytes);
            ASSERT_EQ(renderLinear(frame_).pixels, whole.pixels) << nodes;
        }
        renderer_.setListMemory(FragmentLists::kDefaultLimitBytes);
    }
}

TEST_F(Lists, OfOnePixelThatDoNotFitAreAnError) {
    frame_.camera = fromAbove(10, {4, 4});
    show(frame_, stack64(0.1f));
    renderer_.setListMemory(FragmentLists::kHeaderBytes + 63 * FragmentLists::kNodeBytes);
    EXPECT_THROW(renderer_.render(frame_), Error);
    renderer_.setListMemory(FragmentLists::kHeaderBytes + 64 * FragmentLists::kNodeBytes);
    EXPECT_NO_THROW(renderer_.render(frame_));
}

}  // namespace
}  // namespace isoglass::test
