#include "render_fixture.h"

#include <glm/ext/matrix_transform.hpp>

#include <algorithm>
#include <numeric>
#include <random>

namespace isoglass::test {
namespace {

const glm::vec3 kBackground(0.2f, 0.25f, 0.3f);

class Surfaces : public RenderTest {
  protected:
    FrameDescription frame_{.camera = {.eye = {3, 2, 2.5}, .fovDegrees = 34, .size = {48, 36}},
                            .background = kBackground,
                            .lighting = kUnlit};

    /// Compares with rays against every triangle, for every method. 1e-4: colors are float, eight
    /// fragments with a few operations of 2^-24 each, and below 4.
    void expectGroundTruth(const std::vector<TruthSurface>& surfaces, const std::string& name) {
        frame_.draws.clear();
        show(frame_, surfaces);
        for (const TransparencyMethod method :
             {TransparencyMethod::twoPass, TransparencyMethod::threePass, TransparencyMethod::fourPass,
              TransparencyMethod::peel, TransparencyMethod::exact}) {
            frame_.method = method;
            const TruthImage truth = renderTruth(frame_, surfaces, composerOf(frame_));
            // Only silhouettes may change, each by at most its fragments' colors.
            const double share = double(truth.silhouettePixels()) / double(truth.color.pixels.size());
            EXPECT_LT(share, 0.05);
            EXPECT_EQ(differenceBeyond(
                          {.threshold = 1e-4, .mean = share + 1e-4, .changedShare = share, .largest = 1e-4},
                          name, renderLinear(frame_), truth.color, truth.silhouette),
                      "");
        }
    }
};

std::vector<TruthSurface> overlapping(const glm::dmat4& first, const glm::dmat4& second) {
    return {{sphere({0, 0, 0}, 0.8f, 12),
             {.worldFromSeries = first, .color = {0.9f, 0.2f, 0.1f}, .opacity = 0.4f}},
            {sphere({0, 0, 0}, 0.5f, 12),
             {.worldFromSeries = first, .color = {0.2f, 0.9f, 0.1f}, .opacity = 0.5f}},
            {sphere({0, 0, 0}, 0.7f, 12),
             {.worldFromSeries = second, .color = {0.1f, 0.2f, 0.9f}, .opacity = 0.3f}},
            {sphere({0, 0, 0}, 0.2f, 12),
             {.worldFromSeries = second, .color = {0.7f, 0.7f, 0.1f}, .opacity = 1}}};
}

TEST_F(Surfaces, OfTwoOverlappingVolumesMatchTheGroundTruth) {
    glm::dmat4 second = glm::translate(glm::dmat4(1), glm::dvec3(0.5, 0.2, -0.1));
    second = glm::scale(glm::rotate(second, 0.7, glm::dvec3(1, 2, 3)), glm::dvec3(1.4, 0.7, 1));
    expectGroundTruth(overlapping(glm::dmat4(1), second), "overlapping");
}

TEST_F(Surfaces, OfAMirroredPlacementKeepTheirFaces) {
    const glm::dmat4 mirrored = glm::scale(glm::dmat4(1), glm::dvec3(1, -1.2, 0.8));
    expectGroundTruth(overlapping(mirrored, glm::translate(glm::dmat4(1), glm::dvec3(0.5, 0.2, -0.1))),
                      "mirrored");
}

TEST_F(Surfaces, InADeepZoomMatchTheGroundTruth) {
    frame_.camera.eye = {0.3, 0.2, 0.25};
    expectGroundTruth(overlapping(glm::dmat4(1), glm::translate(glm::dmat4(1), glm::dvec3(0.1, 0, 0))),
                      "zoom");
}

/// Same bound as for the order of draws: 2 (n + 1) 2^-24 (B + sum e), n at most 6 fragments a pixel and
/// the sum at most 0.3 + 2 (0.4 + 0.5 + 0.3).
TEST_F(Surfaces, DoNotDependOnTheOrderOfTheirTriangles) {
    std::vector<TruthSurface> surfaces =
        overlapping(glm::dmat4(1), glm::translate(glm::dmat4(1), glm::dvec3(0.5, 0.2, -0.1)));
    std::mt19937 random(5);
    for (const TransparencyMethod method : {TransparencyMethod::threePass, TransparencyMethod::fourPass}) {
        frame_.method = method;
        frame_.draws.clear();
        show(frame_, surfaces);
        const LinearImage before = renderLinear(frame_);
        for (TruthSurface& surface : surfaces) {
            std::vector<std::array<std::uint32_t, 3>> triangles(surface.mesh.triangleCount());
            std::memcpy(triangles.data(), surface.mesh.triangles.data(), triangles.size() * 12);
            std::shuffle(triangles.begin(), triangles.end(), random);
            std::memcpy(surface.mesh.triangles.data(), triangles.data(), triangles.size() * 12);
        }
        frame_.draws.clear();
        show(frame_, surfaces);
        const LinearImage after = renderLinear(frame_);
        for (std::size_t i = 0; i < before.pixels.size(); ++i) {
            ASSERT_LE(largestDifference(before.pixels[i], after.pixels[i]), 2 * 7 * 0x1p-24 * 2.7);
        }
    }
}

/// Far from the origin of the world the eye-relative matrices differ by the rounding of doubles at 6.4e6,
/// 2^-30; that is 1e-9 of the scene and flips a sample on a silhouette only, if any.
TEST_F(Surfaces, LookTheSameFarFromTheOrigin) {
    const glm::dvec3 shift(6.4e6, -5.1e6, 2.5e6);
    std::vector<TruthSurface> surfaces =
        overlapping(glm::dmat4(1), glm::translate(glm::dmat4(1), glm::dvec3(0.5, 0.25, -0.125)));
    frame_.lighting = {};
    show(frame_, surfaces);
    const LinearImage near = renderLinear(frame_);
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
        // Half by the mesh's origin, half by the placement.
        surfaces[i].mesh.origin = shift * 0.5;
        surfaces[i].draw.worldFromSeries = glm::translate(surfaces[i].draw.worldFromSeries, shift * 0.5);
    }
    frame_.draws.clear();
    show(frame_, surfaces);
    frame_.camera.eye += shift;
    frame_.camera.target += shift;
    const LinearImage far = renderLinear(frame_);
    std::size_t changed = 0;
    for (std::size_t i = 0; i < near.pixels.size(); ++i) {
        changed += largestDifference(near.pixels[i], far.pixels[i]) > 1e-5;
    }
    EXPECT_LE(changed, near.pixels.size() / 200);
}

TEST_F(Surfaces, LeaveTheDepthToTheOpaqueOnes) {
    std::vector<TruthSurface> surfaces = overlapping(glm::dmat4(1), glm::dmat4(1));
    show(frame_, surfaces);
    FrameDescription opaqueOnly = frame_;
    std::erase_if(opaqueOnly.draws, [](const SurfaceDraw& draw) { return draw.opacity < 1; });
    // The near plane follows what is drawn: an opaque speck as far out as the shells keeps it in place.
    SurfaceMesh speck = sphere({0, 0, 0}, 0.8f, 12);
    speck.triangles = {0, 0, 0};
    for (FrameDescription* frame : {&frame_, &opaqueOnly}) {
        frame->draws.push_back({.mesh = renderer_.meshes().upload(speck)});
    }
    renderer_.render(opaqueOnly);
    const DepthImage expected = renderer_.readDepth();
    EXPECT_GT(std::count_if(expected.pixels.begin(), expected.pixels.end(), [](float d) { return d > 0; }),
              20);
    for (const TransparencyMethod method : {TransparencyMethod::threePass, TransparencyMethod::fourPass}) {
        frame_.method = method;
        renderer_.render(frame_);
        EXPECT_EQ(renderer_.readDepth().pixels, expected.pixels);
    }
}

}  // namespace
}  // namespace isoglass::test
