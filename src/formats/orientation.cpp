#include "formats/orientation.h"

#include "base/error.h"

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace isoglass {

namespace {

/// Sines of the angles between two steps below this are rounding: headers keep 6 digits.
constexpr double kRightAngle = 1e-3;
constexpr double kStraightVoxels = 0.01;

std::string numeral(double value) {
    std::array<char, 32> text;
    const auto end =
        std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::general, 9);
    return {text.data(), end.ptr};
}

std::string numerals(std::initializer_list<double> values) {
    std::string text;
    for (const double value : values) text += (text.empty() ? "[" : ", ") + numeral(value);
    return text + "]";
}

void requireRightAngles(const AffinePlace& place, const std::string& file) {
    for (int i = 0; i < 3; ++i) {
        const glm::dvec3 step = place.steps[i];
        const double length = glm::length(step);
        if (!std::isfinite(length) || !std::isfinite(glm::length(place.origin)) || length < 1e-30)
            throw Error("the place of the samples makes no sense: a step is zero or not finite", file,
                        "the header may be damaged");
        const glm::dvec3 next = place.steps[(i + 1) % 3];
        if (std::abs(glm::dot(step, next)) > kRightAngle * length * glm::length(next))
            throw Error("the axes are sheared: two of them are not at right angles", file,
                        "resample the volume to a rectangular grid first");
    }
}

/// The assignment of array axes to world axes whose steps agree best, by the product of the components.
std::array<std::size_t, 3> nearestAxes(const AffinePlace& place) {
    std::array<std::size_t, 3> order{0, 1, 2};
    std::array<std::size_t, 3> best = order;
    double bestAgreement = -1;
    do {
        double agreement = 1;
        for (int world = 0; world < 3; ++world) {
            const glm::dvec3 step = place.steps[order[world]];
            agreement *= std::abs(step[world]) / glm::length(step);
        }
        if (agreement > bestAgreement) {
            bestAgreement = agreement;
            best = order;
        }
    } while (std::ranges::next_permutation(order).found);
    return best;
}

/// How far the farthest sample would be from its place without the rotation, in voxels of its axis.
double skewVoxels(const AffinePlace& place, const std::array<std::size_t, 3>& axes,
                  const std::array<std::uint64_t, 3>& lengths) {
    double worst = 0;
    for (int world = 0; world < 3; ++world) {
        double off = 0;
        for (int other = 0; other < 3; ++other) {
            if (other != world)
                off +=
                    std::abs(place.steps[axes[other]][world]) * static_cast<double>(lengths[axes[other]] - 1);
        }
        worst = std::max(worst, off / glm::length(place.steps[axes[world]]));
    }
    return worst;
}

/// The `place` that brings tables along the world axes to where the file says: a rotation about the first
/// sample, as a scene states it (rotate first, then translate).
std::string placeNote(const AffinePlace& place, const std::array<std::size_t, 3>& axes,
                      const glm::dvec3& signs, const std::string& file) {
    glm::dmat3 rotation;
    for (int world = 0; world < 3; ++world)
        rotation[world] = signs[world] * glm::normalize(place.steps[axes[world]]);
    if (glm::determinant(rotation) < 0)
        throw Error("the axes are oblique and mirrored at once", file, "resample the volume first");
    glm::dquat turn = glm::normalize(glm::quat_cast(rotation));
    if (turn.w < 0) turn = -turn;
    const glm::dvec3 axis = glm::axis(turn);
    const glm::dvec3 translate = place.origin - rotation * place.origin;
    return "The file's axes are oblique; they are kept along the nearest world axes. A scene turns the "
           "volume "
           "to where the file says it is with \"place\": {\"translate\": " +
           numerals({translate.x, translate.y, translate.z}) +
           ", \"rotate\": " + numerals({axis.x, axis.y, axis.z, glm::degrees(glm::angle(turn))}) + "}";
}

}  // namespace

OrientedAxes orient(const AffinePlace& place, const std::array<std::uint64_t, 3>& lengths,
                    const std::string& file) {
    requireRightAngles(place, file);
    OrientedAxes result;
    result.axes = nearestAxes(place);
    const bool oblique = skewVoxels(place, result.axes, lengths) > kStraightVoxels;
    glm::dvec3 signs{1};
    for (int world = 0; world < 3; ++world) {
        const glm::dvec3 step = place.steps[result.axes[world]];
        signs[world] = step[world] < 0 ? -1 : 1;
        const double length = oblique ? signs[world] * glm::length(step) : step[world];
        Axis& axis = result.lattice.axes[world];
        axis.name = std::string(1, "xyz"[world]);
        for (std::uint64_t i = 0; i < lengths[result.axes[world]]; ++i)
            axis.coordinates.push_back(place.origin[world] + static_cast<double>(i) * length);
        if (axis.coordinates.back() == axis.coordinates[axis.coordinates.size() - 2])
            throw Error("the place of the samples makes no sense: the step along " + axis.name +
                            " is lost beside the origin",
                        file, "the header may be damaged");
    }
    if (result.axes != std::array<std::size_t, 3>{0, 1, 2}) {
        std::string order;
        for (const std::size_t axis : result.axes)
            order += (order.empty() ? "" : ", ") + std::to_string(axis + 1);
        result.notes.push_back("The file's axes were reordered: x, y, z are its axes " + order);
    }
    if (oblique) result.notes.push_back(placeNote(place, result.axes, signs, file));
    return result;
}

AffinePlace turnedAboutZ(const AffinePlace& place) {
    AffinePlace turned = place;
    const glm::dvec3 signs{-1, -1, 1};
    turned.origin *= signs;
    for (glm::dvec3& step : turned.steps) step *= signs;
    return turned;
}

}  // namespace isoglass
