#include "scene/scene.h"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <gtest/gtest.h>

#include <cmath>

namespace isoglass {
namespace {

// Poses go through polar coordinates: a few elementary functions on values below 16.
constexpr double kRounding = 16 * 16 * 2.3e-16;

glm::dvec3 onCircle(double degrees, double height = 0) {
    return {5 * std::cos(glm::radians(degrees)), 5 * std::sin(glm::radians(degrees)), height};
}

Camera orbit(std::initializer_list<double> degrees) {
    Camera camera;
    double at = 0;
    for (const double angle : degrees) camera.path.push_back({at++, {onCircle(angle), glm::dvec3(0)}});
    return camera;
}

TEST(CameraPath, WithoutKeysIsThePose) {
    Camera camera;
    camera.pose = {{1, 2, 3}, {4, 5, 6}};
    EXPECT_EQ(camera.poseAt(7), camera.pose);
}

TEST(CameraPath, IsExactAtItsKeysAndStillOutside) {
    const Camera camera = orbit({0, 80, 100});
    for (const CameraKey& key : camera.path) EXPECT_EQ(camera.poseAt(key.at), key.pose);
    EXPECT_EQ(camera.poseAt(-1), camera.path.front().pose);
    EXPECT_EQ(camera.poseAt(99), camera.path.back().pose);
}

TEST(CameraPath, TwoKeysMoveEvenlyOnACircle) {
    const Camera camera = orbit({0, 90});
    for (const double s : {0.25, 0.5, 0.75}) {
        EXPECT_LT(glm::length(camera.poseAt(s).eye - onCircle(90 * s)), kRounding) << s;
    }
}

TEST(CameraPath, FullTurnHasConstantSpeed) {
    const Camera camera = orbit({0, 90, 180, 270, 360});
    for (double s = 0.1; s < 4; s += 0.3) {
        EXPECT_LT(glm::length(camera.poseAt(s).eye - onCircle(90 * s)), kRounding) << s;
    }
}

TEST(CameraPath, TurnsTheShorterWayAcrossTheCut) {
    const Camera camera = orbit({170, 190});
    EXPECT_LT(glm::length(camera.poseAt(0.5).eye - onCircle(180)), kRounding);
}

TEST(CameraPath, DoesNotOvershootAKey) {
    Camera camera;
    const double distances[] = {2, 10, 10, 3, 2.9};
    for (int i = 0; i < 5; ++i) {
        camera.path.push_back({i * i + 0.0, {{distances[i], 0, 1e-3}, {0, 0, 0}}});
    }
    for (std::size_t i = 0; i + 1 < camera.path.size(); ++i) {
        const double low =
            std::min(glm::length(camera.path[i].pose.eye), glm::length(camera.path[i + 1].pose.eye));
        const double high =
            std::max(glm::length(camera.path[i].pose.eye), glm::length(camera.path[i + 1].pose.eye));
        for (double s = 0; s <= 1; s += 0.05) {
            const double at = camera.path[i].at + s * (camera.path[i + 1].at - camera.path[i].at);
            const double distance = glm::length(camera.poseAt(at).eye);
            EXPECT_GE(distance, low - kRounding) << at;
            EXPECT_LE(distance, high + kRounding) << at;
        }
    }
}

TEST(CameraPath, SpeedIsContinuousAcrossKeys) {
    Camera camera = orbit({0, 30, 100, 110});
    camera.path[2].at = 1.7;
    camera.path[3].at = 4;
    camera.path[1].pose.target = {0, 1, 0};
    constexpr double kStep = 1e-5;
    for (const double at : {1.0, 1.7}) {
        const auto before = (camera.poseAt(at).eye - camera.poseAt(at - kStep).eye) / kStep;
        const auto after = (camera.poseAt(at + kStep).eye - camera.poseAt(at).eye) / kStep;
        // One-sided differences err by step * |second derivative|, here below 100; a linear path through
        // these keys would jump by more than 1.
        EXPECT_LT(glm::length(after - before), 100 * kStep) << at;
    }
}

TEST(CameraPath, OppositeEyesNeverMeetTheTargetNorLookAlongUp) {
    Camera camera;
    camera.up = {0, 1, 1};
    camera.path = {{0, {{5, 0, 0}, glm::dvec3(0)}},
                   {1, {{-5, 0, 0}, glm::dvec3(0)}},
                   {2, {{0, -5, 5.5}, glm::dvec3(0)}}};
    for (double at = 0; at <= 2; at += 0.01) {
        const glm::dvec3 arm = camera.poseAt(at).eye;
        ASSERT_GT(glm::length(arm), 5 - kRounding) << at;
        // Where elevations stay between those of the keys (at most 60 degrees), the sine is at least 0.5.
        ASSERT_GT(glm::length(glm::cross(arm, glm::normalize(camera.up))) / glm::length(arm), 0.5) << at;
    }
}

}  // namespace
}  // namespace isoglass
