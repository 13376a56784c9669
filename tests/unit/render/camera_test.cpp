#include "render/camera.h"

#include "base/error.h"

#include <glm/ext/matrix_transform.hpp>
#include <glm/glm.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace isoglass {
namespace {

TEST(Camera, ProjectsTargetCornersAndDepth) {
    const CameraView camera{
        .eye = {0, 0, 10}, .target = {0, 0, 0}, .up = {0, 1, 0}, .fovDegrees = 90, .size = {200, 100}};
    const glm::dmat4 clip = clipFromEye(camera, 0.5);
    const auto project = [&](const glm::dvec3& eyeRelative) {
        const glm::dvec4 p = clip * glm::dvec4(eyeRelative, 1);
        return glm::dvec3(p) / p.w;
    };
    // 90 degrees of height: at distance 10 the upper edge is 10 above, the right edge 20 beside.
    EXPECT_NEAR(glm::length(project({20, 10, -10}) - glm::dvec3(1, 1, 0.05)), 0, 1e-12);
    EXPECT_NEAR(glm::length(project({0, 0, -0.5}) - glm::dvec3(0, 0, 1)), 0, 1e-12);
}

TEST(Camera, LookingAlongUpTakesNorthAsUp) {
    const ViewAxes axes = viewAxes({.eye = {0, 0, 5}, .target = {0, 0, 0}, .up = {0, 0, 1}});
    EXPECT_NEAR(glm::length(axes.up - glm::dvec3(0, 1, 0)), 0, 1e-12);
    EXPECT_NEAR(glm::length(axes.right - glm::dvec3(1, 0, 0)), 0, 1e-12);
    const ViewAxes north = viewAxes({.eye = {0, -5, 0}, .target = {0, 0, 0}, .up = {0, 1, 0}});
    EXPECT_NEAR(glm::length(north.up - glm::dvec3(0, 0, 1)), 0, 1e-12);
}

TEST(Camera, AViewWithoutDirectionIsAnError) {
    EXPECT_THROW(viewAxes({.eye = {1, 1, 1}, .target = {1, 1, 1}}), Error);
    EXPECT_THROW(viewAxes({.eye = {std::numeric_limits<double>::quiet_NaN(), 0, 0}}), Error);
    EXPECT_THROW(viewAxes({.fovDegrees = 0}), Error);
    EXPECT_THROW(viewAxes({.fovDegrees = 180}), Error);
}

TEST(Camera, TheNearPlaneCutsNothingInsideTheView) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> uniform(-1, 1);
    const CameraView camera{.eye = {4, 3, 2}, .fovDegrees = 70, .size = {160, 90}};
    const ViewAxes axes = viewAxes(camera);
    const double tangent = std::tan(glm::radians(35.0));
    for (int i = 0; i < 1000; ++i) {
        // A small box around a point inside the view.
        const double depth = 1 + 5 * std::abs(uniform(random));
        const glm::dvec3 point = camera.eye + depth * (axes.forward + axes.up * (tangent * uniform(random)) +
                                                       axes.right * (tangent * 16 / 9 * uniform(random)));
        const Bounds box{point - 0.01, point + 0.01};
        EXPECT_LE(nearDistance(camera, box), depth);
    }
}

TEST(Camera, ThePlanesOfAViewHoldThePictureAndAPixelAround) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> uniform(-3, 3);
    const CameraView camera{.eye = {400, 3, 2}, .target = {399, 4, 2.5}, .fovDegrees = 50, .size = {160, 90}};
    const glm::dmat4 clip = clipFromEye(camera, 0.1);
    for (const double margin : {0.0, 0.5}) {
        const auto planes = viewPlanes(camera, margin);
        // Half the picture is 1 in clip space, a pixel 2 / size.
        const glm::dvec2 reach = 1.0 + 2.0 * (margin + 1.0 / glm::dvec2(camera.size));
        for (int i = 0; i < 1000; ++i) {
            const glm::dvec3 offset(uniform(random), uniform(random), uniform(random));
            const glm::dvec4 p = clip * glm::dvec4(offset, 1);
            const bool expected = p.w > 0 && std::abs(p.x) < reach.x * p.w && std::abs(p.y) < reach.y * p.w;
            bool inside = true;
            for (const glm::dvec4& plane : planes) {
                EXPECT_NEAR(glm::length(glm::dvec3(plane)), 1, 1e-15);
                inside = inside && glm::dot(plane, glm::dvec4(camera.eye + offset, 1)) > 0;
            }
            EXPECT_EQ(inside, expected);
        }
    }
}

TEST(Camera, TheNearPlaneIsOfTheScalesSize) {
    const CameraView camera{.eye = {0, 0, 0}, .target = {1, 0, 0}};
    EXPECT_EQ(nearDistance(camera, std::nullopt), 1);
    const double outside = nearDistance(camera, Bounds{{100, -1, -1}, {102, 1, 1}});
    EXPECT_GT(outside, 80);
    EXPECT_LT(outside, 100);
    // The eye inside the box: a billionth of the farthest corner.
    EXPECT_NEAR(nearDistance(camera, Bounds{{-3, -4, 0}, {3, 4, 0}}), 5e-9, 1e-15);
}

TEST(Camera, TransformedBoundsHoldEveryCorner) {
    glm::dmat4 map =
        glm::rotate(glm::translate(glm::dmat4(1), glm::dvec3(5, -2, 1)), 1.0, glm::dvec3(1, 2, 3));
    map = glm::scale(map, glm::dvec3(2, -1, 0.5));
    const Bounds box{{-1, 0, 2}, {3, 1, 2.5}};
    const Bounds mapped = transformed(map, box);
    glm::dvec3 low(1e9), high(-1e9);
    for (int i = 0; i < 8; ++i) {
        const glm::dvec4 corner(i & 1 ? box.high.x : box.low.x, i & 2 ? box.high.y : box.low.y,
                                i & 4 ? box.high.z : box.low.z, 1);
        low = glm::min(low, glm::dvec3(map * corner));
        high = glm::max(high, glm::dvec3(map * corner));
    }
    EXPECT_NEAR(glm::length(mapped.low - low) + glm::length(mapped.high - high), 0, 1e-12);
}

TEST(Camera, MatricesDoNotLoseDigitsFarAway) {
    const glm::dmat4 clip = clipFromEye({.eye = {1, 2, 3}}, 0.1);
    const glm::dvec3 far(6.4e6, 6.4e6, -6.4e6);
    const glm::dvec3 origin(0.25, 0.5, -0.75);
    const MeshMatrices near = meshMatrices(clip, {1, 2, 3}, glm::dmat4(1), origin);
    const MeshMatrices moved =
        meshMatrices(clip, far + glm::dvec3(1, 2, 3), glm::translate(glm::dmat4(1), far), origin);
    for (int c = 0; c < 4; ++c) {
        for (int r = 0; r < 4; ++r) {
            // Doubles at 6.4e6 step by 2^-30; the translation of a few units is a float with 2^-23.
            EXPECT_NEAR(near.clipFromMesh[c][r], moved.clipFromMesh[c][r], 0x1p-20);
            EXPECT_NEAR(near.eyeFromMesh[c][r], moved.eyeFromMesh[c][r], 0x1p-20);
        }
    }
}

TEST(Camera, NormalsFollowTheInverseTransposeAndMirrorsAreSeen) {
    glm::dmat4 place =
        glm::scale(glm::rotate(glm::dmat4(1), 0.4, glm::dvec3(1, 1, 0)), glm::dvec3(3, -0.5, 1e-4));
    const MeshMatrices matrices = meshMatrices(glm::dmat4(1), {0, 0, 0}, place, {0, 0, 0});
    EXPECT_TRUE(matrices.mirrored);
    const glm::dmat3 expected = glm::transpose(glm::inverse(glm::dmat3(place)));
    const double factor = glm::length(expected[2]) / glm::length(glm::dvec3(matrices.normalFromMesh[2]));
    for (int column = 0; column < 3; ++column) {
        // Floats relative to the largest element, which is of size 1.
        EXPECT_NEAR(glm::length(glm::dvec3(matrices.normalFromMesh[column]) * factor - expected[column]), 0,
                    factor * 0x1p-22);
    }
    EXPECT_FALSE(meshMatrices(glm::dmat4(1), {0, 0, 0}, glm::dmat4(1), {0, 0, 0}).mirrored);
}

}  // namespace
}  // namespace isoglass
