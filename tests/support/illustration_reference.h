#pragma once

#include "render/image.h"
#include "scene/illustrative_style.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

// The image processing of J. Fischer, D. Bartz and W. Strasser, "Illustrative Display of Hidden Iso-Surface
// Structures", 2005, pixel by pixel in double precision, from normals and distances of the two surfaces. Rows
// go downwards here and upwards in GL, which hatching shows.

namespace isoglass::test {

using Geometry = Raster<glm::vec4>;  ///< normal, and distance along the view axis: 0 where there is nothing

/// From what the geometry passes write: see shaders/lib/seen_surface.glsl.
inline Geometry unpacked(const Raster<glm::uvec2>& texels) {
    Geometry geometry{texels.size, {}};
    for (const glm::uvec2& texel : texels.pixels) {
        const float distance = glm::uintBitsToFloat(texel.x);
        const glm::vec2 p = glm::unpackSnorm2x16(texel.y);
        glm::vec3 normal(p, 1 - std::abs(p.x) - std::abs(p.y));
        if (normal.z < 0) {
            normal.x += normal.x < 0 ? -normal.z : normal.z;
            normal.y += normal.y < 0 ? -normal.z : normal.z;
        }
        geometry.pixels.emplace_back(distance > 0 ? glm::normalize(normal) : glm::vec3(0), distance);
    }
    return geometry;
}

/// A binary decision and how far from rounding it was: the relative distance of what was compared.
struct Decision {
    bool yes = false;
    double margin = std::numeric_limits<double>::infinity();
};

inline double relativeMargin(double a, double b) {
    return std::abs(a - b) / std::max({std::abs(a), std::abs(b), 1e-3});
}

class IllustrationReference {
  public:
    /// `pixelSize` is that at distance 1. The picture's edge goes on as it ends.
    IllustrationReference(const IllustrativeStyle& style, double pixelSize)
        : style_(style), pixelSize_(pixelSize) {}

    /// Equations 3 to 5: their disjunction; also where the surface ends.
    Decision silhouette(const Geometry& surface, int x, int y) const {
        const auto at = [&](int i, int j) {
            return surface.at(std::clamp(x + i, 0, surface.size.x - 1),
                              std::clamp(y + j, 0, surface.size.y - 1));
        };
        int there = 0;
        for (int j = -1; j <= 1; ++j) {
            for (int i = -1; i <= 1; ++i) there += at(i, j).w > 0;
        }
        if (there < 9) return {there > 0};
        const auto w = [&](int i, int j) { return static_cast<double>(at(i, j).w); };
        const double dx = (w(1, -1) + 2 * w(1, 0) + w(1, 1) - w(-1, -1) - 2 * w(-1, 0) - w(-1, 1)) / 8;
        const double dy = (w(-1, 1) + 2 * w(0, 1) + w(1, 1) - w(-1, -1) - 2 * w(0, -1) - w(1, -1)) / 8;
        const double slope = std::hypot(dx, dy) / (w(0, 0) * pixelSize_);
        double similarity = 0;
        for (const auto& [i, j] : {std::pair(1, 0), {-1, 0}, {0, 1}, {0, -1}})
            similarity += glm::dot(glm::dvec3(at(0, 0)), glm::dvec3(at(i, j)));
        const bool jumps = slope >= style_.depthThreshold;
        const bool turns = similarity < style_.normalThreshold;
        const double jumpMargin = relativeMargin(slope, style_.depthThreshold);
        // Near 4 what matters is how far the normals are from parallel.
        const double turnMargin = std::abs(similarity - style_.normalThreshold);
        if (jumps && turns) return {true, std::max(jumpMargin, turnMargin)};
        return {jumps || turns, jumps ? jumpMargin : turns ? turnMargin : std::min(jumpMargin, turnMargin)};
    }

    /// Equations 1 and 6; `light` is towards it, of length 1, in the axes of the normals.
    static double intensity(const glm::dvec3& normal, const glm::dvec3& light) {
        return std::max(glm::dot(normal, light), 0.0);
    }

    /// Equations 7 to 9: whether a stroke covers the pixel. (x, y) is its middle, rows upwards.
    Decision hatched(double light, double x, double y) const {
        const double angle = style_.hatchAngle * M_PI / 180, n = style_.hatchSize, c = style_.hatchCross;
        const double s = fraction((std::cos(angle) * x - std::sin(angle) * y) / n);
        const double t = fraction((std::sin(angle) * x + std::cos(angle) * y) / n);
        const double threshold = s <= c ? c * t : (1 - c) * s + c;
        // The pattern jumps where s or t do, and at s = c.
        const double edge = std::min({s, 1 - s, t, 1 - t, std::abs(s - c)});
        return {light <= threshold, std::min(edge, std::abs(light - threshold))};
    }

  private:
    static double fraction(double v) { return v - std::floor(v); }

    const IllustrativeStyle& style_;
    const double pixelSize_;
};

}  // namespace isoglass::test
