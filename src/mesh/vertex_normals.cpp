#include "mesh/vertex_normals.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <tuple>
#include <unordered_map>
#include <vector>

namespace isoglass {

namespace {

/// Comparing all with all would take for ever.
constexpr std::size_t kMostAround = 1000;

/// For each vertex the first one with its position: files need not share vertices.
std::vector<std::uint32_t> placesOf(const SurfaceMesh& mesh) {
    std::vector<std::uint32_t> order(mesh.vertexCount());
    std::iota(order.begin(), order.end(), 0u);
    std::ranges::sort(order, {}, [&](std::uint32_t vertex) {
        const glm::vec3& p = mesh.positions[vertex];
        return std::tuple(p.x, p.y, p.z, vertex);
    });
    std::vector<std::uint32_t> places(order.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
        const bool again = i > 0 && mesh.positions[order[i]] == mesh.positions[order[i - 1]];
        places[order[i]] = again ? places[order[i - 1]] : order[i];
    }
    return places;
}

/// Corners (indices into `triangles`) of the triangles around each place, one place after the other.
class CornersOfPlaces {
  public:
    CornersOfPlaces(const SurfaceMesh& mesh, const std::vector<std::uint32_t>& places)
        : first_(mesh.vertexCount() + 1), corners_(mesh.triangles.size()) {
        for (const std::uint32_t vertex : mesh.triangles) ++first_[places[vertex] + 1];
        for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
        std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
        for (std::size_t corner = 0; corner < corners_.size(); ++corner)
            corners_[next[places[mesh.triangles[corner]]]++] = corner;
    }

    std::span<const std::size_t> around(std::size_t place) const {
        return {corners_.data() + first_[place], first_[place + 1] - first_[place]};
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

/// Gives corners their normals; a vertex whose corners differ is split.
class NormalsGiven {
  public:
    explicit NormalsGiven(SurfaceMesh& mesh) : mesh_(mesh), isGiven_(mesh.vertexCount()) {
        mesh.normals.assign(mesh.vertexCount(), glm::vec3(0, 0, 1));
    }

    void give(std::size_t corner, const glm::vec3& normal) {
        const std::uint32_t vertex = mesh_.triangles[corner];
        if (!isGiven_[vertex]) {
            isGiven_[vertex] = true;
            mesh_.normals[vertex] = normal;
            return;
        }
        if (mesh_.normals[vertex] == normal) return;
        std::vector<std::uint32_t>& copies = copies_[vertex];
        const auto same = [&](std::uint32_t copy) { return mesh_.normals[copy] == normal; };
        auto found = std::ranges::find_if(copies, same);
        if (found == copies.end()) {
            found = copies.insert(copies.end(), copyOf(vertex, mesh_));
            mesh_.normals.push_back(normal);
        }
        mesh_.triangles[corner] = *found;
    }

  private:
    SurfaceMesh& mesh_;
    std::vector<bool> isGiven_;
    std::unordered_map<std::uint32_t, std::vector<std::uint32_t>> copies_;
};

}  // namespace

void addNormals(SurfaceMesh& mesh, double creaseDegrees) {
    const std::vector<std::uint32_t> places = placesOf(mesh);
    const CornersOfPlaces corners(mesh, places);
    const std::vector<glm::dvec3> areas = areaVectors(mesh);
    const double least = std::cos(creaseDegrees * M_PI / 180);
    const auto isSmooth = [&](const glm::dvec3& a, const glm::dvec3& b) {
        return glm::dot(a, b) >= least * glm::length(a) * glm::length(b);
    };
    const std::size_t vertices = mesh.vertexCount();
    NormalsGiven given(mesh);
    for (std::size_t place = 0; place < vertices; ++place) {
        const auto around = corners.around(place);
        if (around.size() > kMostAround) {
            glm::dvec3 sum(0);
            for (const std::size_t corner : around) sum += areas[corner / 3];
            for (const std::size_t corner : around) given.give(corner, normalFrom(sum));
            continue;
        }
        for (const std::size_t corner : around) {
            glm::dvec3 sum(0);
            for (const std::size_t other : around) {
                if (isSmooth(areas[corner / 3], areas[other / 3])) sum += areas[other / 3];
            }
            given.give(corner, normalFrom(sum));
        }
    }
}

}  // namespace isoglass
