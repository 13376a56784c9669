#pragma once

#include "render/volume_draw.h"
#include "support/cpu_compositor.h"

#include <glm/ext/matrix_transform.hpp>
#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

// Solids that clip, in double precision.

namespace isoglass::test {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Interval {
    double begin = -kInfinity, end = kInfinity;

    Interval operator&(const Interval& other) const {
        return {std::max(begin, other.begin), std::min(end, other.end)};
    }
    bool holds(double t) const { return begin < t && t < end; }
};

/// Where |place + t way| <= 1 in one coordinate.
inline Interval inSlab(double place, double way) {
    if (way == 0) return std::abs(place) <= 1 ? Interval{} : Interval{1, 0};
    const auto [low, high] = std::minmax({(-1 - place) / way, (1 - place) / way});
    return {low, high};
}

/// Where p + t v is in the unit ball: the roots of a quadratic.
inline Interval inBall(const glm::dvec3& p, const glm::dvec3& v) {
    const double a = glm::dot(v, v), b = glm::dot(p, v), c = glm::dot(p, p) - 1;
    const double discriminant = b * b - a * c;
    if (discriminant < 0) return {1, 0};
    return {(-b - std::sqrt(discriminant)) / a, (-b + std::sqrt(discriminant)) / a};
}

/// The part of a ray in a solid; the series is the world.
inline Interval inSolid(const SolidClip& solid, const Ray& ray) {
    const glm::dmat4 own = glm::inverse(solid.seriesFromSolid);
    const glm::dvec3 p(own * glm::dvec4(ray.origin, 1)), v(own * glm::dvec4(ray.direction, 0));
    if (solid.shape == SolidShape::sphere) return inBall(p, v);
    const Interval z = inSlab(p.z, v.z);
    if (solid.shape == SolidShape::cylinder) return z & inBall({p.x, p.y, 0}, {v.x, v.y, 0});
    return z & inSlab(p.x, v.x) & inSlab(p.y, v.y);
}

/// The visible parts of a ray in the box [-1,1]^3, in order.
inline std::vector<Interval> visibleParts(const std::vector<SolidClip>& solids, const Ray& ray) {
    const SolidClip domain{};
    std::vector<std::pair<Interval, Keep>> all{{{0, kInfinity}, Keep::inside},
                                               {inSolid(domain, ray), Keep::inside}};
    for (const SolidClip& solid : solids) all.push_back({inSolid(solid, ray), solid.keep});
    std::vector<double> ends;
    for (const auto& [interval, keep] : all) ends.insert(ends.end(), {interval.begin, interval.end});
    std::ranges::sort(ends);
    std::vector<Interval> parts;
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
        const double middle = 0.5 * (ends[i] + ends[i + 1]);
        const bool kept = std::ranges::all_of(
            all, [&](const auto& each) { return each.first.holds(middle) == (each.second == Keep::inside); });
        if (!kept || ends[i] == ends[i + 1]) continue;
        if (!parts.empty() && parts.back().end == ends[i]) {
            parts.back().end = ends[i + 1];
        } else {
            parts.push_back({ends[i], ends[i + 1]});
        }
    }
    return parts;
}

inline glm::dmat4 placed(const glm::dvec3& at, const glm::dvec3& scale, double degrees = 0,
                         const glm::dvec3& axis = {1, 2, 3}) {
    const glm::dmat4 turned =
        glm::rotate(glm::translate(glm::dmat4(1), at), degrees * M_PI / 180, glm::normalize(axis));
    return glm::scale(turned, scale);
}

}  // namespace isoglass::test
