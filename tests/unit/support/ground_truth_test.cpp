#include "support/ground_truth.h"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <gtest/gtest.h>

#include <cmath>

namespace isoglass::test {
namespace {

constexpr Lighting kUnlit{.ambient = 1, .diffuse = 0, .specular = 0, .shininess = 1};

FrameDescription fromAbove() {
    FrameDescription frame;
    frame.camera = {
        .eye = {0, 0, 4}, .target = {0, 0, 0}, .up = {0, 1, 0}, .fovDegrees = 30, .size = {33, 33}};
    frame.background = glm::vec3(0.5f);
    frame.lighting = kUnlit;
    frame.method = TransparencyMethod::threePass;
    return frame;
}

/// A square around the origin; `diagonal` from lower left to upper right.
TruthSurface square(float z, float half, float opacity, bool facingDown = false) {
    SurfaceMesh mesh;
    mesh.positions = {{-half, -half, z}, {half, -half, z}, {half, half, z}, {-half, half, z}};
    mesh.normals.assign(4, {0, 0, 1});
    mesh.triangles = {0, 1, 2, 0, 2, 3};
    if (facingDown) mesh.triangles = {0, 2, 1, 0, 3, 2};
    return {mesh, {.color = {1, 0, 0}, .opacity = opacity}};
}

/// Rays of the picture's diagonal run through the edge that the square's two triangles share.
TEST(GroundTruth, ASharedEdgeIsHitOnce) {
    const FrameDescription frame = fromAbove();
    const TruthImage truth = renderTruth(frame, {square(0, 10, 0.25f)}, composerOf(frame));
    EXPECT_EQ(truth.deepest, 1u);
    EXPECT_EQ(truth.silhouettePixels(), 0u);
    for (const glm::vec3& c : truth.color.pixels) {
        ASSERT_NEAR(c.r, 0.5 * 0.75 + 0.25, 1e-7);
        ASSERT_NEAR(c.g, 0.5 * 0.75, 1e-7);
    }
}

TEST(GroundTruth, CoincidentSurfacesAreTwo) {
    const FrameDescription frame = fromAbove();
    const TruthImage truth =
        renderTruth(frame, {square(0, 10, 0.25f), square(0, 10, 0.25f)}, composerOf(frame));
    EXPECT_EQ(truth.deepest, 2u);
    EXPECT_NEAR(truth.color.at(16, 16).g, 0.5 * 0.75 * 0.75, 1e-7);
}

/// The edges of a square of half a unit lie 0.5/(4 tan 15) * 33/2 = 7.697 pixels from the middle at 16.5,
/// 0.303 from the centers of columns and rows 8 and 24: a ring of 4 * 16 pixels.
TEST(GroundTruth, SilhouettesAreWithinTheRadiusOfAnEdge) {
    const FrameDescription frame = fromAbove();
    const double edge = 0.5 / (4 * std::tan(glm::radians(15.0))) * 16.5;
    ASSERT_NEAR(edge, 7.697, 1e-3);
    const auto silhouettes = [&](double radius) {
        return renderTruth(frame, {square(0, 0.5f, 1)}, composerOf(frame), {.silhouetteRadius = radius})
            .silhouettePixels();
    };
    EXPECT_EQ(silhouettes(0.29), 0u);
    EXPECT_EQ(silhouettes(0.31), 64u);
}

TEST(GroundTruth, KnowsFrontFromBack) {
    const FrameDescription frame = fromAbove();
    std::vector<Fragment> seen;
    const auto look = [&](const std::vector<Fragment>& fragments) {
        seen = fragments;
        return glm::dvec3(0);
    };
    renderTruth(frame, {square(0, 10, 1), square(1, 10, 0.5f, true)}, look, {.threads = 1});
    ASSERT_EQ(seen.size(), 2u);
    EXPECT_TRUE(seen[0].backFace);
    EXPECT_EQ(seen[0].draw, 1u);
    EXPECT_FALSE(seen[1].backFace);
}

/// A triangle that reaches behind the eye is seen where it lies before it.
TEST(GroundTruth, SeesTrianglesThatPassBehindTheEye) {
    FrameDescription frame = fromAbove();
    frame.camera.eye = {0, 0, 0.5};
    frame.camera.target = {0, 1, 0.5};
    frame.camera.up = {0, 0, 1};
    const TruthImage truth = renderTruth(frame, {square(0, 10, 1)}, composerOf(frame));
    EXPECT_EQ(truth.color.at(16, 32).g, 0.0f) << "the plane below";
    EXPECT_EQ(truth.color.at(16, 0).g, 0.5f) << "nothing above";
}

TEST(GroundTruth, DoesNotDependOnThreads) {
    const FrameDescription frame = fromAbove();
    const std::vector<TruthSurface> surfaces{square(0, 0.7f, 0.3f), square(0.4f, 0.5f, 0.6f, true)};
    const TruthImage one = renderTruth(frame, surfaces, composerOf(frame), {.threads = 1});
    const TruthImage three = renderTruth(frame, surfaces, composerOf(frame), {.threads = 3});
    EXPECT_EQ(one.color.pixels, three.color.pixels);
    EXPECT_EQ(one.silhouette.pixels, three.silhouette.pixels);
}

}  // namespace
}  // namespace isoglass::test
