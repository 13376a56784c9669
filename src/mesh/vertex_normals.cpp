#include "mesh/vertex_normals.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace isoglass {

namespace {

/// Comparing all with all would take for ever.
constexpr std::size_t kMostAround = 1000;

/// Corners (places in `triangles`) of the triangles around each vertex, one vertex after the other.
class CornersOfVertices {
  public:
    explicit CornersOfVertices(const SurfaceMesh& mesh)
        : first_(mesh.vertexCount() + 1), corners_(mesh.triangles.size()) {
        for (const std::uint32_t vertex : mesh.triangles) ++first_[vertex + 1];
        for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
        std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
        for (std::size_t corner = 0; corner < corners_.size(); ++corner)
            corners_[next[mesh.triangles[corner]]++] = corner;
    }

    std::span<const std::size_t> around(std::size_t vertex) const {
        return {corners_.data() + first_[vertex], first_[vertex + 1] - first_[vertex]};
    }

  private:
    std::vector<std::size_t> first_;
    std::vector<std::size_t> corners_;
};

std::vector<glm::dvec3> areaVectors(const SurfaceMesh& mesh) {
    std::vector<glm::dvec3> areas;
    areas.reserve(mesh.triangleCount());
    for (std::size_t i = 0; i < mesh.triangles.size(); i += 3) {
        const auto corner = [&](std::size_t k) { return glm::dvec3(mesh.positions[mesh.triangles[i + k]]); };
        areas.push_back(glm::cross(corner(1) - corner(0), corner(2) - corner(0)));
    }
    return areas;
}

/// Never zero, and of a length that a float holds.
glm::vec3 normalFrom(const glm::dvec3& sum) {
    const double length = glm::length(sum);
    return length > 0 ? glm::vec3(sum / length) : glm::vec3(0, 0, 1);
}

std::uint32_t copyOf(std::size_t vertex, SurfaceMesh& mesh) {
    const auto repeat = [vertex](auto& values) {
        if (!values.empty()) values.push_back(values[vertex]);
    };
    repeat(mesh.positions);
    repeat(mesh.colorValues);
    repeat(mesh.velocities);
    return static_cast<std::uint32_t>(mesh.positions.size() - 1);
}

}  // namespace

void addNormals(SurfaceMesh& mesh, double creaseDegrees) {
    const CornersOfVertices corners(mesh);
    const std::vector<glm::dvec3> areas = areaVectors(mesh);
    const double least = std::cos(creaseDegrees * M_PI / 180);
    const auto isSmooth = [&](const glm::dvec3& a, const glm::dvec3& b) {
        return glm::dot(a, b) >= least * glm::length(a) * glm::length(b);
    };
    const std::size_t vertices = mesh.vertexCount();
    mesh.normals.assign(vertices, glm::vec3(0, 0, 1));
    std::vector<std::uint32_t> own;  // vertices that this one was split into
    for (std::size_t vertex = 0; vertex < vertices; ++vertex) {
        own.clear();
        const auto around = corners.around(vertex);
        if (around.size() > kMostAround) {
            glm::dvec3 sum(0);
            for (const std::size_t corner : around) sum += areas[corner / 3];
            mesh.normals[vertex] = normalFrom(sum);
            continue;
        }
        for (const std::size_t corner : around) {
            glm::dvec3 sum(0);
            for (const std::size_t other : around) {
                if (isSmooth(areas[corner / 3], areas[other / 3])) sum += areas[other / 3];
            }
            const glm::vec3 normal = normalFrom(sum);
            std::uint32_t& named = mesh.triangles[corner];
            const auto same = [&](std::uint32_t split) { return mesh.normals[split] == normal; };
            if (const auto found = std::ranges::find_if(own, same); found != own.end()) {
                named = *found;
                continue;
            }
            if (!own.empty()) {
                named = copyOf(vertex, mesh);
                mesh.normals.push_back(normal);
            }
            mesh.normals[named] = normal;
            own.push_back(named);
        }
    }
}

}  // namespace isoglass
