#include "mesh/mesh_check.h"
#include "support/boundary_check.h"
#include "support/random_fields.h"
#include "unit/surface/surface_check.h"

#include <gtest/gtest.h>

#include <set>
#include <utility>

namespace isoglass {
namespace {

using test::extractDense;

struct Field {
    Lattice lattice;
    std::vector<float> samples;
    float iso = 0;
};

/// Fields of few different values (0, 1, ...; iso-value 1), so that the iso-value equals many samples and
/// surfaces touch themselves wherever they can.
Field integerField(std::uint32_t seed, std::uint32_t missingPercent, std::uint32_t values = 3) {
    static constexpr std::array<glm::ivec3, 4> kDims = {{{9, 9, 9}, {16, 16, 16}, {17, 10, 8}, {5, 23, 12}}};
    const glm::ivec3 dims = kDims[seed % kDims.size()];
    Field field{makeUniformLattice(dims, glm::dvec3(0), glm::dvec3(1)), randomIntegers(dims, values, seed),
                1};
    removeSamples(field.samples, missingPercent, seed + 1000);
    return field;
}

std::string describe(const MeshTopology& topology) {
    return std::to_string(topology.nonManifoldEdges) + " non-manifold edges, " +
           std::to_string(topology.misorientedEdges) + " misoriented, " +
           std::to_string(topology.nonManifoldVertices) + " non-manifold vertices, " +
           std::to_string(topology.degenerateTriangles) + " degenerate triangles";
}

TEST(ExtractTopology, WholeFieldsGiveOrientedManifolds) {
    for (std::uint32_t seed = 0; seed < 40; ++seed) {
        for (const bool below : {false, true}) {
            const Field field = integerField(seed, 0, 3 + seed % 3);
            const SurfaceMesh mesh =
                extractDense(field.lattice, field.samples, {.iso = field.iso, .insideIsBelow = below}).mesh;
            ASSERT_GT(mesh.triangleCount(), 100u);
            const MeshTopology topology = checkTopology(mesh);
            EXPECT_TRUE(topology.isOrientedManifold()) << describe(topology);
            EXPECT_EQ(topology.unreferencedVertices, 0u);
        }
    }
}

// Where of the four cells around an edge two opposite ones lack samples, the fans of the other two would
// share the edge's vertex and nothing else: such an edge has two vertices.
TEST(ExtractTopology, BesideMissingSamplesMeshesAreManifoldsToo) {
    std::size_t pinched = 0;
    for (std::uint32_t seed = 0; seed < 40; ++seed) {
        const Field field = integerField(seed, 1 + seed % 4 * 10);
        const SurfaceMesh mesh = extractDense(field.lattice, field.samples, {.iso = field.iso}).mesh;
        const MeshTopology topology = checkTopology(mesh);
        EXPECT_TRUE(topology.isOrientedManifold()) << describe(topology);
        EXPECT_EQ(topology.unreferencedVertices, 0u);
        pinched += extractReference(field.lattice, field.samples, field.iso).pinchedEdges;
    }
    EXPECT_GT(pinched, 0u);
}

using test::boundaryEdges;
using test::liesBesideMissing;
using test::liesOnTheEnd;
using Edge = test::MeshEdge;

TEST(ExtractTopology, BoundaryLiesWhereTheDomainEndsOrSamplesAreMissing) {
    for (std::uint32_t seed = 0; seed < 24; ++seed) {
        for (const std::uint32_t missing : {0u, 5u}) {
            Field field = integerField(seed, missing);
            // No crossing at a lattice point: then a position tells which face of a cell it lies in.
            field.iso = 0.5f;
            const SurfaceMesh mesh = extractDense(field.lattice, field.samples, {.iso = field.iso}).mesh;
            const auto edges = boundaryEdges(mesh);
            EXPECT_GT(edges.size(), 0u);
            for (const Edge& edge : edges) {
                ASSERT_TRUE(
                    liesOnTheEnd(mesh, edge, field.lattice.cells()) ||
                    (missing > 0 && liesBesideMissing(mesh, edge, field.lattice.dims(), field.samples)))
                    << "seed " << seed;
            }
        }
    }
}

TEST(ExtractTopology, PeriodicAxesHaveNoSeam) {
    // With all axes periodic the boundary lies on the closing planes alone, and what it cuts on one side
    // it cuts on the other: every boundary edge at 0 has its image at the period.
    Lattice lattice = makeUniformLattice({16, 9, 8}, glm::dvec3(0), glm::dvec3(1));
    for (Axis& axis : lattice.axes) axis.period = static_cast<double>(axis.size());
    const auto samples = randomFloats(lattice.dims(), 1);
    const SurfaceMesh mesh = extractDense(lattice, samples, {.iso = 0}).mesh;
    EXPECT_TRUE(checkTopology(mesh).isOrientedManifold());
    std::set<std::array<float, 6>> ends[3][2];
    for (const Edge& edge : boundaryEdges(mesh)) {
        ASSERT_TRUE(liesOnTheEnd(mesh, edge, lattice.cells()));
        for (int k = 0; k < 3; ++k) {
            for (const int side : {0, 1}) {
                glm::vec3 a = mesh.positions[edge[0]];
                glm::vec3 b = mesh.positions[edge[1]];
                const float plane = side ? static_cast<float>(lattice.axes[k].size()) : 0;
                if (a[k] != plane || b[k] != plane) continue;
                a[k] = b[k] = 0;
                if (std::pair(b.x, std::pair(b.y, b.z)) < std::pair(a.x, std::pair(a.y, a.z)))
                    std::swap(a, b);
                ends[k][side].insert({a.x, a.y, a.z, b.x, b.y, b.z});
            }
        }
    }
    for (int k = 0; k < 3; ++k) {
        EXPECT_GT(ends[k][0].size(), 0u);
        EXPECT_EQ(ends[k][0], ends[k][1]) << "axis " << k;
    }
}

TEST(ExtractTopology, PositionsAndNormalsAreFiniteAndNormalsNeverZero) {
    // Few integers: gradients vanish often. Ends of the float range: differences overflow or underflow.
    std::vector<Field> fields;
    for (std::uint32_t seed = 0; seed < 16; ++seed) fields.push_back(integerField(seed, seed % 2 * 10));
    for (const float scale : {1.6e38f, 1e-38f, 0x1p-149f}) {
        for (std::uint32_t seed = 16; seed < 20; ++seed) {
            Field field = integerField(seed, 0);
            for (float& sample : field.samples) sample = (sample - 1) * scale;
            field.iso = 0;
            fields.push_back(field);
        }
    }
    for (const Field& field : fields) {
        for (const bool below : {false, true}) {
            const SurfaceMesh mesh =
                extractDense(field.lattice, field.samples, {.iso = field.iso, .insideIsBelow = below}).mesh;
            ASSERT_FALSE(mesh.empty());
            EXPECT_EQ(measure(mesh).nonFiniteVertices, 0u);
            for (const glm::vec3& normal : mesh.normals) {
                ASSERT_TRUE(std::isfinite(normal.x) && std::isfinite(normal.y) && std::isfinite(normal.z));
                ASSERT_TRUE(normal.x != 0 || normal.y != 0 || normal.z != 0);
            }
        }
    }
}

TEST(ExtractTopology, ZeroAreaTrianglesStayInTheGraph) {
    // One sample inside, equal to the iso-value: a sphere shrunk to a point.
    const Lattice lattice = makeUniformLattice({5, 5, 5}, glm::dvec3(0), glm::dvec3(1));
    std::vector<float> samples(125, 0);
    samples[sampleAt(lattice.dims(), {2, 2, 2})] = 1;
    const SurfaceMesh mesh = extractDense(lattice, samples, {.iso = 1}).mesh;
    const MeshTopology topology = checkTopology(mesh);
    EXPECT_GT(measure(mesh).zeroAreaTriangles, 0u);
    EXPECT_TRUE(topology.isOrientedManifold() && topology.isClosed()) << describe(topology);
    EXPECT_EQ(topology.eulerNumber, 2);
}

TEST(ExtractTopology, SameBytesForAnyNumberOfThreadsOnIntegerFields) {
    for (std::uint32_t seed = 0; seed < 8; ++seed) {
        Field field = integerField(seed, seed % 2 * 10);
        const auto frame = makeKeyFrame(field.lattice, field.samples);
        const auto run = [&](int threads) {
            return test::extractFrame(field.lattice, frame, {.iso = field.iso, .threads = threads}).mesh;
        };
        for (const int threads : {2, 3, 7}) EXPECT_TRUE(test::sameBytes(run(1), run(threads)));
    }
}

}  // namespace
}  // namespace isoglass
