#pragma once

#include "mesh/mesh_check.h"
#include "support/mesh_boundary.h"
#include "surface/extract.h"
#include "unit/levels/level_case.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <map>
#include <string>
#include <vector>

namespace isoglass::test {

/// Vertices of one key that differ in a bit of position or normal.
inline std::size_t unequalVertices(const std::vector<MeshPart>& parts) {
    struct Vertex {
        VertexKey key;
        std::array<glm::vec3, 2> values;
    };
    std::vector<Vertex> vertices;
    for (const MeshPart& part : parts) {
        for (const MeshPart::Shared& entry : part.shared)
            vertices.push_back({entry.key, {part.positions[entry.vertex], part.normals[entry.vertex]}});
    }
    std::ranges::sort(vertices, {}, &Vertex::key);
    std::size_t unequal = 0;
    for (std::size_t i = 1; i < vertices.size(); ++i) {
        const Vertex& a = vertices[i - 1];
        const Vertex& b = vertices[i];
        unequal += a.key == b.key && std::memcmp(&a.values, &b.values, sizeof a.values) != 0;
    }
    return unequal;
}

/// Index position along an axis of a world coordinate, by straight lines between samples.
inline double indexOf(const Axis& axis, double coordinate) {
    const double sign = axis.descending() ? -1 : 1;
    std::size_t i = 0;
    while (i + 2 <= axis.cells() && sign * axis.coordinate(i + 1) <= sign * coordinate) ++i;
    return static_cast<double>(i) +
           (coordinate - axis.coordinate(i)) / (axis.coordinate(i + 1) - axis.coordinate(i));
}

/// Whether a face of the cell that holds the point has a missing sample within a cell of the point.
inline bool besideMissing(const LevelCase& c, glm::dvec3 index) {
    const glm::ivec3 dims = c.lattice.dims();
    const auto isMissing = [&](glm::ivec3 i) {
        for (int k = 0; k < 3; ++k) i[k] = c.lattice.axes[k].period ? i[k] % dims[k] : i[k];
        const std::size_t place = (static_cast<std::size_t>(i.z) * dims.y + i.y) * dims.x + i.x;
        return (c.field.fraction < 1 && std::isnan(c.samples[0][place])) ||
               (c.field.fraction > 0 && std::isnan(c.samples[1][place]));
    };
    const glm::ivec3 first = glm::max(glm::ivec3(glm::floor(index)) - 1, glm::ivec3(0));
    const glm::ivec3 last = glm::min(glm::ivec3(glm::floor(index)) + 2, c.lattice.cells());
    glm::ivec3 i;
    for (i.z = first.z; i.z <= last.z; ++i.z) {
        for (i.y = first.y; i.y <= last.y; ++i.y) {
            for (i.x = first.x; i.x <= last.x; ++i.x) {
                const glm::dvec3 away = glm::abs(glm::dvec3(i) - index);
                // Positions are floats: an index is known to a thousandth.
                if (std::max({away.x, away.y, away.z}) <= 1.001 && isMissing(i)) return true;
            }
        }
    }
    return false;
}

/// Boundary edges that lie neither in a face of the domain nor in a cell that lacks a sample.
inline std::size_t strayBoundaryEdges(const LevelCase& c, const SurfaceMesh& mesh) {
    const auto bounds = c.lattice.bounds();
    std::size_t stray = 0;
    for (const auto& edge : boundaryEdges(mesh)) {
        const glm::dvec3 a = glm::dvec3(mesh.positions[edge[0]]) + mesh.origin;
        const glm::dvec3 b = glm::dvec3(mesh.positions[edge[1]]) + mesh.origin;
        bool allowed = false;
        for (int k = 0; k < 3; ++k) {
            for (const glm::dvec3& corner : bounds) {
                // A vertex where the domain cuts an edge is a mean of two vertices: three roundings of half
                // an ulp of the largest coordinate.
                const double tolerance = 1.5 * std::numeric_limits<float>::epsilon() *
                                         std::max(std::abs(bounds[0][k] - mesh.origin[k]),
                                                  std::abs(bounds[1][k] - mesh.origin[k]));
                allowed |= std::abs(a[k] - corner[k]) <= tolerance && std::abs(b[k] - corner[k]) <= tolerance;
            }
        }
        if (!allowed) {
            glm::dvec3 index;
            for (int k = 0; k < 3; ++k) index[k] = indexOf(c.lattice.axes[k], 0.5 * (a[k] + b[k]));
            allowed = besideMissing(c, index);
        }
        stray += !allowed;
    }
    return stray;
}

struct Totals {
    std::size_t triangles = 0;
    std::map<int, std::size_t> bricks;
    std::size_t views = 0;
};

inline void expectWatertight(const LevelCase& c, Totals& totals) {
    const Selected selected(c);
    std::vector<MeshPart> parts = selected.mesh(c);
    EXPECT_EQ(unequalVertices(parts), 0u) << c.name;
    const SurfaceMesh mesh = joinParts(parts, selected.space.levels[0].origin, 1);
    const MeshTopology topology = checkTopology(mesh);
    EXPECT_EQ(topology.nonManifoldEdges, 0u) << c.name;
    EXPECT_EQ(topology.misorientedEdges, 0u) << c.name;
    EXPECT_EQ(topology.degenerateTriangles, 0u) << c.name;
    EXPECT_EQ(topology.unreferencedVertices, 0u) << c.name;
    EXPECT_EQ(measure(mesh).nonFiniteVertices, 0u) << c.name;
    EXPECT_EQ(strayBoundaryEdges(c, mesh), 0u) << c.name;
    for (const glm::vec3& normal : mesh.normals) {
        if (!(glm::dot(normal, normal) > 0)) {
            ADD_FAILURE() << c.name << ": a normal is zero or not finite";
            break;
        }
    }
    totals.triangles += mesh.triangleCount();
    for (const LevelBrick& brick : selected.bricks) ++totals.bricks[brick.level];
    ++totals.views;
}

inline std::string levelCounts(const Totals& totals) {
    std::string text;
    for (const auto& [level, count] : totals.bricks)
        text += " level " + std::to_string(level) + ": " + std::to_string(count);
    return text;
}

}  // namespace isoglass::test
