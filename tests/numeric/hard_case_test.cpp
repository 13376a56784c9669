#include "numeric/digital_topology.h"
#include "numeric/hard_cases.h"
#include "numeric/table_row.h"
#include "support/boundary_check.h"
#include "support/surface_reference.h"
#include "unit/surface/surface_check.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <ostream>
#include <string>
#include <vector>

namespace isoglass::numeric {

void PrintTo(const HardCase& hard, std::ostream* out) {
    *out << hard.name << ": " << hard.reason;
}

namespace {

class HardCases : public testing::TestWithParam<HardCase> {
  protected:
    const HardCase& hard_ = GetParam();
    Extraction extract(int threads = 1) const {
        return extractSurface(hard_.lattice, hard_.field(), hard_.options(threads));
    }
};

DigitalTopology digitalTopologyOf(const HardCase& hard) {
    return digitalTopology(hard.lattice.dims(), hard.samplesInTime(), hard.iso, hard.below);
}

/// Those whose surface meets neither the domain's end nor missing samples.
class ClosedHardCases : public HardCases {
  public:
    static std::vector<HardCase> cases() {
        std::vector<HardCase> closed;
        std::ranges::copy_if(hardCases(), std::back_inserter(closed),
                             [](const HardCase& hard) { return digitalTopologyOf(hard).closed; });
        return closed;
    }
};

bool isFinite(const glm::vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

TEST_P(HardCases, GiveAFiniteOrientedManifold) {
    const SurfaceMesh mesh = extract().mesh;
    addTableRow(hard_.name, hard_.danger, describe(mesh));
    for (std::size_t i = 0; i < mesh.vertexCount(); ++i) {
        ASSERT_TRUE(isFinite(mesh.positions[i]) && isFinite(mesh.normals[i])) << "vertex " << i;
        ASSERT_NE(mesh.normals[i], glm::vec3(0)) << "vertex " << i;
    }
    const MeshTopology topology = checkTopology(mesh);
    EXPECT_TRUE(topology.isOrientedManifold()) << describe(mesh);
    EXPECT_EQ(topology.unreferencedVertices, 0u);
}

// Which edges are open is asked of the index: positions are those of the unit lattice with the same samples.
TEST_P(HardCases, AreOpenOnlyWhereTheDomainEndsOrSamplesAreMissing) {
    const glm::ivec3 dims = hard_.lattice.dims();
    const Lattice unit = makeUniformLattice(dims, glm::dvec3(0), glm::dvec3(1));
    const SurfaceMesh mesh = extractSurface(unit, hard_.field(), hard_.options()).mesh;
    const auto samples = hard_.samplesInTime();
    for (const test::MeshEdge& edge : test::boundaryEdges(mesh)) {
        ASSERT_TRUE(test::liesOnTheEnd(mesh, edge, unit.cells()) ||
                    test::liesBesideMissing(mesh, edge, dims, samples));
    }
}

TEST_P(HardCases, GiveTheExpectedAnswer) {
    const Extraction found = extract();
    const MeshTopology topology = checkTopology(found.mesh);
    const MeshMeasures measures = measure(found.mesh);
    const HardCase::Answer& answer = hard_.answer;
    SCOPED_TRACE(hard_.reason + "; found: " + describe(found.mesh));
    if (answer.closed) {
        EXPECT_FALSE(found.mesh.empty());
        EXPECT_EQ(topology.isClosed(), *answer.closed);
    }
    if (answer.triangles) {
        EXPECT_EQ(found.mesh.triangleCount(), *answer.triangles);
    }
    if (answer.components) {
        EXPECT_EQ(topology.components, *answer.components);
    }
    if (answer.eulerNumber) {
        EXPECT_EQ(topology.eulerNumber, *answer.eulerNumber);
    }
    EXPECT_EQ(found.stats.lostCells > 0, answer.loses);
    // Coordinates are rounded to half an ulp of the largest, L; a triangle's area and a volume's share change
    // by at most that times a side times a few: sides below L, so 4 ulp of L^2 and L^3 a triangle.
    double largest = 0;
    for (const glm::vec3& p : found.mesh.positions)
        for (int k = 0; k < 3; ++k) largest = std::max(largest, static_cast<double>(std::abs(p[k])));
    const double slack = 4 * std::numeric_limits<float>::epsilon() * largest * largest *
                         static_cast<double>(found.mesh.triangleCount());
    if (answer.area) {
        EXPECT_NEAR(measures.area, *answer.area, slack);
    }
    if (answer.volume) {
        EXPECT_NEAR(measures.volume, *answer.volume, slack * largest);
    }
}

TEST_P(HardCases, GiveTheReferenceByEdgeIdentity) {
    const Extraction found = extract();
    const ReferenceSurface wanted =
        extractReference(hard_.lattice, hard_.samplesInTime(), hard_.iso, hard_.below);
    // Normals have tests of their own: where a difference quotient is no float, the engine's take another
    // way.
    EXPECT_EQ(
        differenceFromReference(found.mesh, wanted, test::positionTolerance(hard_.lattice, found.mesh.origin),
                                std::numeric_limits<double>::infinity()),
        "");
    EXPECT_EQ(found.stats.lostCells, wanted.lostCells);
}

TEST_P(ClosedHardCases, HaveTheTopologyOfTheSamplesAlone) {
    const DigitalTopology digital = digitalTopologyOf(hard_);
    const MeshTopology topology = checkTopology(extract().mesh);
    EXPECT_EQ(topology.components, digital.surfaceComponents);
    EXPECT_EQ(topology.eulerNumber, digital.surfaceEulerNumber);
}

TEST_P(HardCases, GiveTheSameBytesForAnyNumberOfThreads) {
    const SurfaceMesh one = extract(1).mesh;
    for (const int threads : {2, 3, 0}) EXPECT_TRUE(test::sameBytes(one, extract(threads).mesh)) << threads;
}

// Seen from beside a corner and from afar, with cells as large as a view may ask for.
TEST_P(HardCases, GiveAFiniteOrientedManifoldWithLevelsOfDetail) {
    const auto bounds = hard_.lattice.bounds();
    const glm::dvec3 sides = bounds[1] - bounds[0];
    for (const double distance : {0.1, 2.0}) {
        ExtractOptions options = hard_.options();
        options.view = View{.eye = bounds[1] + distance * sides, .pixelsPerUnit = 140, .cellPixels = 10};
        const SurfaceMesh mesh = extractSurface(hard_.lattice, hard_.field(), options).mesh;
        for (std::size_t i = 0; i < mesh.vertexCount(); ++i) {
            ASSERT_TRUE(isFinite(mesh.positions[i]) && isFinite(mesh.normals[i])) << "vertex " << i;
            ASSERT_NE(mesh.normals[i], glm::vec3(0)) << "vertex " << i;
        }
        const MeshTopology topology = checkTopology(mesh);
        EXPECT_EQ(topology.nonManifoldEdges, 0u);
        EXPECT_EQ(topology.misorientedEdges, 0u);
    }
}

std::string nameOf(const testing::TestParamInfo<HardCase>& instance) {
    return instance.param.name;
}

INSTANTIATE_TEST_SUITE_P(Numeric, HardCases, testing::ValuesIn(hardCases()), nameOf);
INSTANTIATE_TEST_SUITE_P(Numeric, ClosedHardCases, testing::ValuesIn(ClosedHardCases::cases()), nameOf);

}  // namespace
}  // namespace isoglass::numeric
