#include "mesh/vertex_normals.h"

#include "example_meshes.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>

namespace isoglass {
namespace {

/// Each corner of a cube becomes three vertices, each with the normal of its face; the triangles stay.
TEST(VertexNormals, SharpEdgesStaySharp) {
    const SurfaceMesh cube = makeCube();
    SurfaceMesh mesh = cube;
    addNormals(mesh);
    EXPECT_EQ(mesh.vertexCount(), 24u);
    ASSERT_EQ(mesh.normals.size(), 24u);
    ASSERT_EQ(mesh.triangles.size(), cube.triangles.size());
    for (std::size_t i = 0; i < mesh.triangles.size(); i += 3) {
        const auto corner = [&](std::size_t k) { return mesh.positions[mesh.triangles[i + k]]; };
        const glm::vec3 face = glm::normalize(glm::cross(corner(1) - corner(0), corner(2) - corner(0)));
        for (std::size_t k = 0; k < 3; ++k) {
            EXPECT_EQ(corner(k), cube.positions[cube.triangles[i + k]]);
            EXPECT_EQ(mesh.normals[mesh.triangles[i + k]], face);
        }
    }
}

TEST(VertexNormals, SmoothSurfacesAreNotSplit) {
    SurfaceMesh mesh = makeTorus(64, 32);
    const std::vector<glm::vec3> right = mesh.normals;
    const std::size_t vertices = mesh.vertexCount();
    addNormals(mesh);
    ASSERT_EQ(mesh.vertexCount(), vertices);
    // Patches turn by 2 pi / 32 from one to the next; the mean of those around a vertex is off by less than
    // half of that.
    for (std::size_t i = 0; i < vertices; ++i)
        EXPECT_GT(glm::dot(mesh.normals[i], glm::normalize(right[i])), std::cos(M_PI / 32)) << i;
}

/// The same surface, each triangle with vertices of its own.
TEST(VertexNormals, VerticesNeedNotBeShared) {
    SurfaceMesh shared = makeTorus(32, 16), soup;
    for (const std::uint32_t vertex : shared.triangles) {
        soup.triangles.push_back(static_cast<std::uint32_t>(soup.positions.size()));
        soup.positions.push_back(shared.positions[vertex]);
    }
    addNormals(shared);
    addNormals(soup);
    ASSERT_EQ(soup.vertexCount(), soup.triangles.size());
    for (std::size_t i = 0; i < soup.triangles.size(); ++i)
        EXPECT_LT(glm::distance(soup.normals[soup.triangles[i]], shared.normals[shared.triangles[i]]), 1e-6f)
            << i;
}

TEST(VertexNormals, AnAngleDecidesWhatIsSharp) {
    SurfaceMesh mesh = makeCube();
    addNormals(mesh, 91);
    EXPECT_EQ(mesh.vertexCount(), 8u);
}

TEST(VertexNormals, ValuesAreCopiedWithSplitVertices) {
    SurfaceMesh mesh = makeCube();
    mesh.colorValues = {0, 1, 2, 3, 4, 5, 6, 7};
    addNormals(mesh);
    ASSERT_EQ(mesh.colorValues.size(), 24u);
    for (std::size_t i = 0; i < 24; ++i) {
        const glm::vec3 p = mesh.positions[i];
        EXPECT_EQ(mesh.colorValues[i], p.x + 2 * p.y + 4 * p.z);
    }
}

/// Vertices without triangles, triangles without area, and a fan of more triangles than are compared.
TEST(VertexNormals, AreNeverZero) {
    SurfaceMesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {5, 5, 5}};
    mesh.triangles = {0, 1, 2, 0, 0, 1};
    addNormals(mesh);
    for (const glm::vec3& normal : mesh.normals) EXPECT_FLOAT_EQ(glm::length(normal), 1);
    SurfaceMesh fan;
    fan.positions = {{0, 0, 0}};
    constexpr std::uint32_t kAround = 1500;
    for (std::uint32_t i = 0; i < kAround; ++i) {
        fan.positions.emplace_back(std::cos(2 * M_PI * i / kAround), std::sin(2 * M_PI * i / kAround), 0);
        fan.triangles.insert(fan.triangles.end(), {0, i + 1, (i + 1) % kAround + 1});
    }
    addNormals(fan);
    EXPECT_EQ(fan.vertexCount(), kAround + 1);
    for (const glm::vec3& normal : fan.normals) EXPECT_LT(glm::distance(normal, glm::vec3(0, 0, 1)), 1e-6f);
}

}  // namespace
}  // namespace isoglass
