#include "study_meshes.h"

#include "surface/extract.h"
#include "volume/analytic.h"

#include <glm/vec2.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace isoglass {

namespace {

float manyCells(glm::dvec3 p, double) {
    const glm::dvec3 q = 6 * M_PI * p;
    return static_cast<float>(std::sin(q.x) * std::cos(q.y) + std::sin(q.y) * std::cos(q.z) +
                              std::sin(q.z) * std::cos(q.x));
}

using Outline = std::vector<glm::vec2>;

Outline circle(glm::vec2 center, float radius, int corners) {
    Outline outline;
    for (int i = 0; i < corners; ++i) {
        const double angle = 2 * M_PI * i / corners;
        outline.push_back(center + radius * glm::vec2(std::cos(angle), std::sin(angle)));
    }
    return outline;
}

/// Teeth that follow a clipped cosine.
Outline gear(glm::vec2 center, float radius, int teeth, double phase) {
    constexpr int kCornersPerTooth = 20;
    Outline outline = circle(center, 1, teeth * kCornersPerTooth);
    for (int i = 0; i < teeth * kCornersPerTooth; ++i) {
        const double wave = std::cos(2 * M_PI * i / kCornersPerTooth + phase);
        const auto height = static_cast<float>(std::clamp(2 * wave, -1.0, 1.0));
        glm::vec2& corner = outline[static_cast<std::size_t>(i)];
        corner = center + (corner - center) * (radius + 0.035f * height);
    }
    return outline;
}

void addQuad(SurfaceMesh& mesh, const std::array<std::uint32_t, 4>& q) {
    mesh.triangles.insert(mesh.triangles.end(), {q[0], q[1], q[2], q[0], q[2], q[3]});
}

/// The body between two outlines with the same number of corners (`inner` within `outer`), from `low` to
/// `high`.
void addRing(SurfaceMesh& mesh, const Outline& outer, const Outline& inner, float low, float high) {
    const auto count = static_cast<std::uint32_t>(outer.size());
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (const float z : {low, high}) {
        for (const Outline* outline : {&outer, &inner}) {
            for (const glm::vec2& corner : *outline) mesh.positions.emplace_back(corner, z);
        }
    }
    const auto vertex = [&](std::uint32_t ring, std::uint32_t i) { return first + ring * count + i % count; };
    for (std::uint32_t i = 0; i < count; ++i) {
        // Rings: 0 outer low, 1 inner low, 2 outer high, 3 inner high.
        addQuad(mesh, {vertex(0, i), vertex(0, i + 1), vertex(2, i + 1), vertex(2, i)});
        addQuad(mesh, {vertex(1, i + 1), vertex(1, i), vertex(3, i), vertex(3, i + 1)});
        addQuad(mesh, {vertex(2, i), vertex(2, i + 1), vertex(3, i + 1), vertex(3, i)});
        addQuad(mesh, {vertex(0, i + 1), vertex(0, i), vertex(1, i), vertex(1, i + 1)});
    }
}

/// A square with corners on the rays of a circle's.
Outline square(float half, int corners) {
    Outline outline = circle({0, 0}, 1, corners);
    for (glm::vec2& corner : outline) corner *= half / std::max(std::abs(corner.x), std::abs(corner.y));
    return outline;
}

}  // namespace

SurfaceMesh makeGyroid() {
    const Lattice lattice = makeUnitLattice(193);
    return extractSurface(lattice, {makeAnalyticFrame(lattice, manyCells, 0), nullptr, 0}, {.iso = 0}).mesh;
}

SurfaceMesh makeGearbox() {
    SurfaceMesh mesh;
    constexpr std::array kTeeth{20, 36, 16, 28, 24, 40};
    float x = -0.62f, y = -0.45f;
    for (std::size_t i = 0; i < kTeeth.size(); ++i) {
        const float radius = 0.011f * static_cast<float>(kTeeth[i]);
        const int corners = 20 * kTeeth[i];
        const float low = -0.5f + 0.17f * static_cast<float>(i);
        addRing(mesh, gear({x, y}, radius, kTeeth[i], M_PI * static_cast<double>(i)),
                circle({x, y}, 0.4f * radius, corners), low, low + 0.14f);
        // The next one meshes with it on another side and level.
        const double turn = 0.9 * static_cast<double>(i);
        x = std::clamp(x + 0.45f * static_cast<float>(std::cos(turn)), -0.5f, 0.5f);
        y = std::clamp(y + 0.45f * static_cast<float>(std::sin(turn)), -0.45f, 0.45f);
    }
    // Casing: four walls, a floor with a hole and a lid with a larger one.
    constexpr int kCorners = 256;
    addRing(mesh, square(1, kCorners), square(0.92f, kCorners), -0.7f, 0.75f);
    addRing(mesh, square(1, kCorners), circle({0, 0}, 0.15f, kCorners), -0.78f, -0.7f);
    addRing(mesh, square(1, kCorners), circle({0, 0}, 0.55f, kCorners), 0.75f, 0.83f);
    return mesh;
}

SurfaceMesh makeShaft() {
    SurfaceMesh mesh;
    constexpr int kCorners = 128;
    addRing(mesh, circle({0, 0}, 0.12f, kCorners), circle({0, 0}, 0.05f, kCorners), -1.1f, 1.15f);
    return mesh;
}

}  // namespace isoglass
