#include "support/mesh_weld.h"

#include "mesh/mesh_check.h"

#include <gtest/gtest.h>

#include <cmath>

namespace isoglass::test {
namespace {

/// Two triangles beside an edge, as a soup of six vertices: one piece by position, two by identity.
TEST(WeldByPosition, JoinsASoupAlongEqualPositions) {
    SurfaceMesh soup;
    soup.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}, {-0.0f, 1, 0}};
    soup.normals.assign(6, {0, 0, 1});
    soup.triangles = {0, 1, 2, 3, 4, 5};
    EXPECT_EQ(checkTopology(soup).components, 2u);
    const SurfaceMesh welded = weldByPosition(soup);
    EXPECT_EQ(welded.vertexCount(), 4u);
    const MeshTopology topology = checkTopology(welded);
    EXPECT_EQ(topology.components, 1u);
    EXPECT_EQ(topology.boundaryEdges, 4u);
    EXPECT_TRUE(topology.isOrientedManifold());
}

/// Neighbouring floats are different positions: nothing is rounded.
TEST(WeldByPosition, LeavesNeighbouringFloatsApart) {
    SurfaceMesh mesh;
    mesh.positions = {glm::vec3(1, 0, 0), glm::vec3(std::nextafter(1.0f, 2.0f), 0, 0)};
    mesh.normals.assign(2, {0, 0, 1});
    EXPECT_EQ(weldByPosition(mesh).vertexCount(), 2u);
}

}  // namespace
}  // namespace isoglass::test
