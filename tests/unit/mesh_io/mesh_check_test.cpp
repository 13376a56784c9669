#include "mesh/mesh_check.h"

#include "example_meshes.h"

#include <gtest/gtest.h>

#include <limits>

namespace isoglass {

void PrintTo(const MeshTopology& t, std::ostream* stream) {
    *stream << "boundary " << t.boundaryEdges << ", non-manifold edges " << t.nonManifoldEdges
            << ", misoriented " << t.misorientedEdges << ", degenerate " << t.degenerateTriangles
            << ", non-manifold vertices " << t.nonManifoldVertices << ", unreferenced "
            << t.unreferencedVertices << ", components " << t.components << ", Euler " << t.eulerNumber;
}

namespace {

SurfaceMesh triangles(std::size_t vertices, std::vector<std::uint32_t> indices) {
    SurfaceMesh mesh;
    mesh.positions.resize(vertices);
    mesh.triangles = std::move(indices);
    return mesh;
}

TEST(MeshTopology, ClosedSurfacesHaveTheirEulerNumbers) {
    EXPECT_EQ(checkTopology(makeTetrahedron()), (MeshTopology{.components = 1, .eulerNumber = 2}));
    EXPECT_EQ(checkTopology(makeCube()), (MeshTopology{.components = 1, .eulerNumber = 2}));
    EXPECT_EQ(checkTopology(makeTorus(7, 5)), (MeshTopology{.components = 1, .eulerNumber = 0}));
    EXPECT_TRUE(checkTopology(makeTorus(7, 5)).isClosed());
    EXPECT_TRUE(checkTopology(makeTorus(7, 5)).isOrientedManifold());
}

TEST(MeshTopology, SeparatePiecesAreCounted) {
    SurfaceMesh mesh = makeCube();
    append(mesh, makeCube(), {5, 0, 0});
    EXPECT_EQ(checkTopology(mesh), (MeshTopology{.components = 2, .eulerNumber = 4}));
}

TEST(MeshTopology, EmptyMeshHasNothing) {
    EXPECT_EQ(checkTopology(SurfaceMesh{}), MeshTopology{});
    EXPECT_TRUE(checkTopology(SurfaceMesh{}).isClosed());
}

TEST(MeshTopology, OpenSheetHasABoundary) {
    // Two triangles share the edge 1-2; the other four edges are the boundary of a disk.
    const MeshTopology topology = checkTopology(triangles(4, {0, 1, 2, 2, 1, 3}));
    EXPECT_EQ(topology, (MeshTopology{.boundaryEdges = 4, .components = 1, .eulerNumber = 1}));
    EXPECT_TRUE(topology.isOrientedManifold());
    EXPECT_FALSE(topology.isClosed());
}

TEST(MeshTopology, FlippedTriangleIsMisorientedAtItsThreeEdges) {
    SurfaceMesh mesh = makeCube();
    std::swap(mesh.triangles[0], mesh.triangles[1]);
    const MeshTopology topology = checkTopology(mesh);
    EXPECT_EQ(topology, (MeshTopology{.misorientedEdges = 3, .components = 1, .eulerNumber = 2}));
    EXPECT_FALSE(topology.isOrientedManifold());
}

TEST(MeshTopology, EdgeOfThreeTrianglesIsNotManifold) {
    const MeshTopology topology = checkTopology(triangles(5, {0, 1, 2, 1, 0, 3, 0, 1, 4}));
    EXPECT_EQ(topology.nonManifoldEdges, 1u);
    EXPECT_EQ(topology.boundaryEdges, 6u);
    EXPECT_EQ(topology.nonManifoldVertices, 2u);
    EXPECT_FALSE(topology.isOrientedManifold());
}

TEST(MeshTopology, PinchedVertexIsFound) {
    // Two tetrahedra that share vertex 0 only: every edge is in two triangles, the surface is not a manifold.
    SurfaceMesh mesh = makeTetrahedron();
    append(mesh, makeTetrahedron(), {5, 0, 0});
    for (std::uint32_t& index : mesh.triangles) index = index == 4 ? 0 : index;
    const MeshTopology topology = checkTopology(mesh);
    EXPECT_EQ(topology,
              (MeshTopology{
                  .nonManifoldVertices = 1, .unreferencedVertices = 1, .components = 1, .eulerNumber = 3}));
    EXPECT_FALSE(topology.isOrientedManifold());
}

TEST(MeshTopology, OpenFansThatTouchInAVertexAreFound) {
    EXPECT_EQ(checkTopology(triangles(5, {0, 1, 2, 0, 3, 4})).nonManifoldVertices, 1u);
}

TEST(MeshTopology, DegenerateTrianglesAreCountedAndLeftOut) {
    const MeshTopology topology = checkTopology(triangles(4, {0, 1, 2, 2, 1, 2, 3, 3, 3}));
    EXPECT_EQ(topology.degenerateTriangles, 2u);
    EXPECT_EQ(topology.boundaryEdges, 3u);
    EXPECT_EQ(topology.unreferencedVertices, 1u);
}

TEST(MeshMeasures, CubeHasItsAreaVolumeAndBounds) {
    const MeshMeasures measures = measure(makeCube());
    // Sums of small dyadic numbers (and sixths of them): a few units in the last place.
    EXPECT_NEAR(measures.area, 6, 1e-14);
    EXPECT_NEAR(measures.volume, 1, 1e-14);
    EXPECT_EQ(measures.bounds[0], glm::dvec3(0));
    EXPECT_EQ(measures.bounds[1], glm::dvec3(1));
    EXPECT_EQ(measures.zeroAreaTriangles, 0u);
    EXPECT_EQ(measures.nonFiniteVertices, 0u);
}

TEST(MeshMeasures, VolumeChangesItsSignWithTheWinding) {
    SurfaceMesh mesh = makeCube();
    for (std::size_t t = 0; t < mesh.triangles.size(); t += 3)
        std::swap(mesh.triangles[t], mesh.triangles[t + 1]);
    EXPECT_NEAR(measure(mesh).volume, -1, 1e-14);
}

TEST(MeshMeasures, VolumeIsExactFarFromTheOrigin) {
    SurfaceMesh mesh;
    append(mesh, makeCube(), {1048576, 1048576, 1048576});
    EXPECT_NEAR(measure(mesh).volume, 1, 1e-14);
}

TEST(MeshMeasures, BadVerticesAndZeroAreasAreCounted) {
    SurfaceMesh mesh = makeCube();
    mesh.positions.emplace_back(std::numeric_limits<float>::quiet_NaN(), 0, 0);
    mesh.positions.emplace_back(0, std::numeric_limits<float>::infinity(), 0);
    mesh.positions.emplace_back(0.5f, 0, 0);
    mesh.triangles.insert(mesh.triangles.end(), {0, 1, 8, 0, 10, 1, 9, 0, 1});
    const MeshMeasures measures = measure(mesh);
    EXPECT_EQ(measures.nonFiniteVertices, 2u);
    EXPECT_EQ(measures.zeroAreaTriangles, 1u);
    EXPECT_NEAR(measures.area, 6, 1e-14);
    EXPECT_EQ(measures.bounds[1], glm::dvec3(1));
}

TEST(MeshMeasures, EmptyMeshMeasuresNothing) {
    EXPECT_EQ(measure(SurfaceMesh{}), MeshMeasures{});
}

}  // namespace
}  // namespace isoglass
