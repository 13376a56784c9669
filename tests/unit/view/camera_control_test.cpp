#include "app/view/camera_control.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace isoglass {
namespace {

const CameraPose kPose{.eye = {3, -5, 2}, .target = {0.5, 1, -0.25}};
const Lens kLens{.up = {0, 0, 1}, .fovDegrees = 40};
/// Some dozens of operations on numbers below 10 round to less than this.
constexpr double kRounding = 1e-13;

/// Where the picture shows a point, in heights of the window from its middle, y downwards.
glm::dvec2 onScreen(const CameraPose& pose, const glm::dvec3& point) {
    const ViewAxes axes = viewAxes({.eye = pose.eye, .target = pose.target, .up = kLens.up});
    const glm::dvec3 arm = point - pose.eye;
    const double height =
        2 * glm::dot(arm, axes.forward) * std::tan(kLens.fovDegrees * std::numbers::pi / 360);
    return {glm::dot(arm, axes.right) / height, -glm::dot(arm, axes.up) / height};
}

double distance(const CameraPose& pose) {
    return glm::distance(pose.eye, pose.target);
}

void expectNear(const glm::dvec3& a, const glm::dvec3& b) {
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(a[i], b[i], kRounding) << "coordinate " << i;
}

TEST(Orbit, NoDragIsThePoseItself) {
    EXPECT_EQ(orbited(kPose, kLens, {0, 0}), kPose);
    EXPECT_EQ(panned(kPose, kLens, {0, 0}), kPose);
}

TEST(Orbit, TheWindowsHeightIsHalfATurnAboutUp) {
    const CameraPose turned = orbited(kPose, kLens, {1, 0});
    const glm::dvec3 arm = kPose.eye - kPose.target;
    expectNear(turned.target, kPose.target);
    expectNear(turned.eye - turned.target, {-arm.x, -arm.y, arm.z});
}

TEST(Orbit, KeepsTheDistanceAndTheTarget) {
    const CameraPose turned = orbited(kPose, kLens, {0.17, -0.11});
    EXPECT_EQ(turned.target, kPose.target);
    EXPECT_NEAR(distance(turned), distance(kPose), kRounding);
}

TEST(Orbit, WhatLiesInFrontFollowsTheDrag) {
    // A point between eye and target, in the middle of the picture.
    const glm::dvec3 front = 0.5 * (kPose.eye + kPose.target);
    EXPECT_GT(onScreen(orbited(kPose, kLens, {0.02, 0}), front).x, 0.001);
    EXPECT_LT(onScreen(orbited(kPose, kLens, {-0.02, 0}), front).x, -0.001);
    EXPECT_GT(onScreen(orbited(kPose, kLens, {0, 0.02}), front).y, 0.001);
    EXPECT_LT(onScreen(orbited(kPose, kLens, {0, -0.02}), front).y, -0.001);
}

TEST(Orbit, StopsBeforeItLooksAlongUp) {
    for (const double drag : {-3.0, 3.0}) {
        const CameraPose turned = orbited(kPose, kLens, {0, drag});
        const glm::dvec3 arm = glm::normalize(turned.eye - turned.target);
        // 0.1 degrees from the pole.
        EXPECT_NEAR(std::abs(arm.z), std::cos(0.1 * std::numbers::pi / 180), kRounding);
        // It never tips over: the eye stays on its side.
        const glm::dvec3 before = kPose.eye - kPose.target;
        EXPECT_GT(arm.x * before.x + arm.y * before.y, 0);
    }
}

TEST(Orbit, WorksWithAnyUp) {
    const Lens lens{.up = {0, 2, 0}, .fovDegrees = 30};
    const CameraPose turned = orbited(kPose, lens, {1, 0});
    const glm::dvec3 arm = kPose.eye - kPose.target;
    expectNear(turned.eye - turned.target, {-arm.x, arm.y, -arm.z});
}

TEST(Pan, TheTargetFollowsTheCursor) {
    const CameraPose moved = panned(kPose, kLens, {0.3, -0.2});
    const glm::dvec2 shown = onScreen(moved, kPose.target);
    EXPECT_NEAR(shown.x, 0.3, kRounding);
    EXPECT_NEAR(shown.y, -0.2, kRounding);
    expectNear(moved.target - moved.eye, kPose.target - kPose.eye);
}

TEST(Zoom, ThePointUnderTheCursorStays) {
    const glm::dvec2 cursor(0.4, 0.25);
    // The world point that the cursor shows, at the target's distance.
    const glm::dvec3 point = panned(kPose, kLens, -cursor).target;
    ASSERT_NEAR(onScreen(kPose, point).x, cursor.x, kRounding);
    for (const double factor : {0.5, 0.9, 1.7}) {
        const CameraPose moved = zoomed(kPose, kLens, cursor, factor);
        EXPECT_NEAR(onScreen(moved, point).x, cursor.x, kRounding);
        EXPECT_NEAR(onScreen(moved, point).y, cursor.y, kRounding);
        EXPECT_NEAR(distance(moved), factor * distance(kPose), kRounding);
    }
}

TEST(Zoom, InTheMiddleTheTargetStays) {
    const CameraPose moved = zoomed(kPose, kLens, {0, 0}, 0.25);
    EXPECT_EQ(moved.target, kPose.target);
}

TEST(Fit, AllCornersAreInThePictureAndOneIsNearItsEdge) {
    const Bounds box{{-1, 4, 100}, {3, 5, 117}};
    for (const double aspect : {0.5, 1.0, 16.0 / 9}) {
        const CameraPose pose = fitted(box, kLens, {0.5, 1, -0.4}, aspect);
        double fullest = 0;
        for (int corner = 0; corner < 8; ++corner) {
            const glm::dvec3 point(corner & 1 ? box.low.x : box.high.x, corner & 2 ? box.low.y : box.high.y,
                                   corner & 4 ? box.low.z : box.high.z);
            const glm::dvec2 shown = glm::abs(onScreen(pose, point));
            fullest = std::max({fullest, 2 * shown.x / aspect, 2 * shown.y});
        }
        // The margin of 5 % is taken at the distance of the corner, so exactly 1 / 1.05 of the half is used.
        EXPECT_NEAR(fullest, 1 / 1.05, 1e-12) << "aspect " << aspect;
    }
}

TEST(Fit, APointIsSeenFromDistanceOne) {
    const CameraPose pose = fitted({{1, 2, 3}, {1, 2, 3}}, kLens, {0, 1, 0}, 1);
    EXPECT_EQ(pose, (CameraPose{.eye = {1, 1, 3}, .target = {1, 2, 3}}));
}

}  // namespace
}  // namespace isoglass
