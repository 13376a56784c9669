#include "support/mesh_distance.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace isoglass::test {

namespace {

std::array<glm::dvec3, 3> corners(const SurfaceMesh& mesh, std::size_t first) {
    std::array<glm::dvec3, 3> result;
    for (std::size_t i = 0; i < 3; ++i) result[i] = mesh.positions[mesh.triangles[first + i]];
    return result;
}

double oneWay(const SurfaceMesh& from, const MeshDistance& to, double reach) {
    double largest = 0;
    for (const glm::vec3& vertex : from.positions) largest = std::max(largest, to.at(vertex, reach));
    for (std::size_t t = 0; t < from.triangles.size(); t += 3) {
        const auto triangle = corners(from, t);
        largest = std::max(largest, to.at((triangle[0] + triangle[1] + triangle[2]) / 3.0, reach));
    }
    return largest;
}

}  // namespace

double distanceToTriangle(glm::dvec3 p, glm::dvec3 a, glm::dvec3 b, glm::dvec3 c) {
    const auto toSegment = [p](glm::dvec3 from, glm::dvec3 to) {
        const glm::dvec3 along = to - from;
        const double square = glm::dot(along, along);
        const double t = square > 0 ? std::clamp(glm::dot(p - from, along) / square, 0.0, 1.0) : 0;
        return glm::length(p - from - t * along);
    };
    double nearest = std::min({toSegment(a, b), toSegment(b, c), toSegment(c, a)});
    const glm::dvec3 normal = glm::cross(b - a, c - a);
    const double square = glm::dot(normal, normal);
    if (!(square > 0)) return nearest;
    const auto isLeft = [&](glm::dvec3 from, glm::dvec3 to) {
        return glm::dot(glm::cross(to - from, p - from), normal) >= 0;
    };
    if (isLeft(a, b) && isLeft(b, c) && isLeft(c, a))
        nearest = std::min(nearest, std::abs(glm::dot(p - a, normal)) / std::sqrt(square));
    return nearest;
}

MeshDistance::MeshDistance(const SurfaceMesh& mesh, double cellSize) : mesh_(mesh), cellSize_(cellSize) {
    if (mesh.positions.empty()) return;
    glm::dvec3 high = low_ = mesh.positions[0];
    for (const glm::vec3& position : mesh.positions) {
        low_ = glm::min(low_, glm::dvec3(position));
        high = glm::max(high, glm::dvec3(position));
    }
    dims_ = glm::ivec3((high - low_) / cellSize_) + 1;
    cells_.resize(static_cast<std::size_t>(dims_.x) * dims_.y * dims_.z);
    for (std::size_t t = 0; t < mesh.triangles.size(); t += 3) {
        const auto triangle = corners(mesh, t);
        const glm::ivec3 first = cellOf(glm::min(glm::min(triangle[0], triangle[1]), triangle[2]));
        const glm::ivec3 last = cellOf(glm::max(glm::max(triangle[0], triangle[1]), triangle[2]));
        glm::ivec3 i;
        for (i.z = first.z; i.z <= last.z; ++i.z) {
            for (i.y = first.y; i.y <= last.y; ++i.y) {
                for (i.x = first.x; i.x <= last.x; ++i.x)
                    cells_[(static_cast<std::size_t>(i.z) * dims_.y + i.y) * dims_.x + i.x].push_back(
                        static_cast<std::uint32_t>(t));
            }
        }
    }
}

glm::ivec3 MeshDistance::cellOf(glm::dvec3 point) const {
    return glm::clamp(glm::ivec3(glm::floor((point - low_) / cellSize_)), glm::ivec3(0), dims_ - 1);
}

double MeshDistance::at(glm::dvec3 point, double reach) const {
    double nearest = std::numeric_limits<double>::infinity();
    if (cells_.empty()) return nearest;
    const glm::ivec3 center = cellOf(point);
    // What a ring of cells holds lies at least ring - 1 cells away, and more where the point is outside.
    for (int ring = 0; (ring - 1) * cellSize_ <= std::min(nearest, reach); ++ring) {
        const glm::ivec3 first = glm::max(center - ring, glm::ivec3(0));
        const glm::ivec3 last = glm::min(center + ring, dims_ - 1);
        glm::ivec3 i;
        for (i.z = first.z; i.z <= last.z; ++i.z) {
            for (i.y = first.y; i.y <= last.y; ++i.y) {
                for (i.x = first.x; i.x <= last.x; ++i.x) {
                    const glm::ivec3 away = glm::abs(i - center);
                    if (std::max({away.x, away.y, away.z}) != ring) continue;
                    for (const std::uint32_t t :
                         cells_[(static_cast<std::size_t>(i.z) * dims_.y + i.y) * dims_.x + i.x]) {
                        const auto triangle = corners(mesh_, t);
                        nearest = std::min(nearest,
                                           distanceToTriangle(point, triangle[0], triangle[1], triangle[2]));
                    }
                }
            }
        }
        if (ring > std::max({dims_.x, dims_.y, dims_.z})) break;
    }
    return nearest <= reach ? nearest : std::numeric_limits<double>::infinity();
}

double surfaceDistance(const SurfaceMesh& a, const SurfaceMesh& b, double cellSize, double reach) {
    if (a.empty() && b.empty()) return 0;
    return std::max(oneWay(a, MeshDistance(b, cellSize), reach), oneWay(b, MeshDistance(a, cellSize), reach));
}

}  // namespace isoglass::test
