#include "scene/scene.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>

namespace isoglass {

namespace {

/// Everything of a pose that is interpolated: target x, y, z, azimuth, elevation, log distance.
using Channels = std::array<double, 6>;
constexpr std::size_t kAzimuth = 3;

/// Right-handed, `up` first.
struct Frame {
    glm::dvec3 up, right, ahead;
};

Frame makeFrame(glm::dvec3 up) {
    const glm::dvec3 axis = glm::normalize(up);
    // The coordinate axis least along `up` gives the cross product of largest length.
    glm::dvec3 helper(0);
    const glm::dvec3 size = glm::abs(axis);
    helper[size.x <= size.y && size.x <= size.z ? 0 : size.y <= size.z ? 1 : 2] = 1;
    const glm::dvec3 right = glm::normalize(glm::cross(helper, axis));
    return {axis, right, glm::cross(axis, right)};
}

Channels channelsOf(const CameraPose& pose, const Frame& frame) {
    const glm::dvec3 arm = pose.eye - pose.target;
    const double height = glm::dot(arm, frame.up);
    const double x = glm::dot(arm, frame.right);
    const double y = glm::dot(arm, frame.ahead);
    return {pose.target.x,
            pose.target.y,
            pose.target.z,
            std::atan2(y, x),
            std::atan2(height, std::hypot(x, y)),
            std::log(glm::length(arm))};
}

CameraPose poseOf(const Channels& channels, const Frame& frame) {
    const glm::dvec3 target(channels[0], channels[1], channels[2]);
    const auto [azimuth, elevation, distance] = std::array{channels[3], channels[4], std::exp(channels[5])};
    const glm::dvec3 level = std::cos(azimuth) * frame.right + std::sin(azimuth) * frame.ahead;
    const glm::dvec3 direction = std::cos(elevation) * level + std::sin(elevation) * frame.up;
    return {target + distance * direction, target};
}

/// Slope at an inner key: weighted harmonic mean of the slopes beside it, 0 at a local extremum.
double innerSlope(double h0, double h1, double slope0, double slope1) {
    if (slope0 * slope1 <= 0) return 0;
    const double w0 = 2 * h1 + h0;
    const double w1 = h1 + 2 * h0;
    return (w0 + w1) / (w0 / slope0 + w1 / slope1);
}

/// Slope at an end key: that of the parabola through three keys, limited so that the cubic is monotone.
double endSlope(double h0, double h1, double slope0, double slope1) {
    const double slope = ((2 * h0 + h1) * slope0 - h0 * slope1) / (h0 + h1);
    if (slope * slope0 <= 0) return 0;
    if (slope0 * slope1 <= 0 && std::abs(slope) > 3 * std::abs(slope0)) return 3 * slope0;
    return slope;
}

/// One channel of the keys around a time. `at` and `value` hold 2 to 4 entries, of which `left` and
/// `left + 1` enclose the time.
double interpolate(std::span<const double> at, std::span<const double> value, std::size_t left, double time) {
    const auto step = [&](std::size_t i) { return at[i + 1] - at[i]; };
    const auto slope = [&](std::size_t i) { return (value[i + 1] - value[i]) / step(i); };
    const std::size_t last = at.size() - 1;
    const std::size_t right = left + 1;
    if (last == 1) return value[0] + (value[1] - value[0]) * (time - at[0]) / step(0);

    const double slopeLeft = left > 0 ? innerSlope(step(left - 1), step(left), slope(left - 1), slope(left))
                                      : endSlope(step(0), step(1), slope(0), slope(1));
    const double slopeRight = right < last
                                  ? innerSlope(step(left), step(right), slope(left), slope(right))
                                  : endSlope(step(left), step(left - 1), slope(left), slope(left - 1));
    const double h = step(left);
    const double s = (time - at[left]) / h;
    const double rise = value[right] - value[left];
    return value[left] +
           s * (h * slopeLeft * (1 - s) * (1 - s) + rise * s * (3 - 2 * s) - h * slopeRight * s * (1 - s));
}

}  // namespace

CameraPose Camera::poseAt(double playbackSeconds) const {
    if (path.empty()) return pose;
    if (playbackSeconds <= path.front().at) return path.front().pose;
    if (playbackSeconds >= path.back().at) return path.back().pose;

    const auto after = std::upper_bound(path.begin(), path.end(), playbackSeconds,
                                        [](double time, const CameraKey& key) { return time < key.at; });
    const auto index = static_cast<std::size_t>(after - path.begin()) - 1;
    if (path[index].at == playbackSeconds) return path[index].pose;

    const std::size_t first = index > 0 ? index - 1 : 0;
    const std::size_t count = std::min(index + 3, path.size()) - first;
    const Frame frame = makeFrame(up);
    std::array<double, 4> at;
    std::array<Channels, 4> keys;
    for (std::size_t i = 0; i < count; ++i) {
        at[i] = path[first + i].at;
        keys[i] = channelsOf(path[first + i].pose, frame);
        if (i > 0) {
            const double turn = keys[i][kAzimuth] - keys[i - 1][kAzimuth];
            keys[i][kAzimuth] = keys[i - 1][kAzimuth] + std::remainder(turn, 2 * std::numbers::pi);
        }
    }
    Channels channels;
    for (std::size_t channel = 0; channel < channels.size(); ++channel) {
        std::array<double, 4> value;
        for (std::size_t i = 0; i < count; ++i) value[i] = keys[i][channel];
        channels[channel] =
            interpolate({at.data(), count}, {value.data(), count}, index - first, playbackSeconds);
    }
    return poseOf(channels, frame);
}

}  // namespace isoglass
