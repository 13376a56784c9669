#include "support/random_fields.h"
#include "surface/index_space.h"
#include "unit/surface/surface_check.h"
#include "volume/analytic.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace isoglass {
namespace {

TEST(MeshOrigin, IsZeroWhereFloatsResolveTheLattice) {
    EXPECT_EQ(meshOrigin(makeUnitLattice(256)), glm::dvec3(0));
    EXPECT_EQ(meshOrigin(makeUniformLattice({360, 180, 20}, {-180, -90, -5000}, {1, 1, 250})), glm::dvec3(0));
}

// Zero while largest * 2^-23 <= step / 1024: with a step of 1, up to 2^13 = 8192.
TEST(MeshOrigin, ChangesWhereFloatsResolveAThousandthOfTheStepNoMore) {
    const auto upTo = [](double largest) {
        return makeUniformLattice({11, 11, 11}, {largest - 10, 0, 0}, glm::dvec3(1));
    };
    EXPECT_EQ(meshOrigin(upTo(8192)), glm::dvec3(0));
    EXPECT_EQ(meshOrigin(upTo(8193)), glm::dvec3(8188, 5, 5));
}

TEST(MeshOrigin, IsTheMiddleInWholeUnitsFarFromZero) {
    // UTM in metres, steps of 30 m; Earth-centred coordinates, steps of 10 m.
    const Lattice utm = makeUniformLattice({101, 101, 11}, {500000.25, 5.2e6, 0}, {30, 30, 10});
    EXPECT_EQ(meshOrigin(utm), glm::dvec3(501500, 5201500, 50));
    const Lattice earth = makeUniformLattice({11, 11, 11}, {6.4e6, -6.4e6, 0}, glm::dvec3(10));
    EXPECT_EQ(meshOrigin(earth), glm::dvec3(6400050, -6399950, 50));
}

TEST(MeshOrigin, AccountsForDescendingAndPeriodicAxes) {
    Lattice lattice = makeUniformLattice({11, 11, 11}, {1e6, 0, 0}, {-1, 1, 1});
    EXPECT_EQ(meshOrigin(lattice).x, 999995);
    // A period that reaches further than the samples counts too.
    lattice = makeUniformLattice({10, 11, 11}, {0, 0, 0}, glm::dvec3(1));
    lattice.axes[0].period = 1e6;
    EXPECT_EQ(meshOrigin(lattice).x, 500000);
}

// The shifts are whole numbers far below 2^53, so the doubles of both lattices are exact and the relative
// coordinates differ by nothing but the origins' difference; each float is rounded once.
TEST(MeshOrigin, ShiftedLatticeGivesTheSameMesh) {
    const glm::ivec3 dims(17, 9, 13);
    const auto samples = randomFloats(dims, 1);
    const Lattice near = makeUniformLattice(dims, glm::dvec3(-8, -4, -6), glm::dvec3(1));
    const SurfaceMesh wanted = test::extractDense(near, samples, {.iso = 0}).mesh;
    ASSERT_EQ(wanted.origin, glm::dvec3(0));
    for (const glm::dvec3 shift :
         {glm::dvec3(500000, 5.2e6, 0), glm::dvec3(6.4e6), glm::dvec3(-1e9, 3, 1e9)}) {
        const Lattice far = makeUniformLattice(dims, glm::dvec3(-8, -4, -6) + shift, glm::dvec3(1));
        const SurfaceMesh mesh = test::extractDense(far, samples, {.iso = 0}).mesh;
        EXPECT_NE(mesh.origin, glm::dvec3(0));
        EXPECT_EQ(mesh.triangles, wanted.triangles);
        ASSERT_EQ(mesh.vertexCount(), wanted.vertexCount());
        // Coordinates relative to the origin are below 16: two roundings of half an ulp of 16 each.
        const double tolerance = 16 * std::numeric_limits<float>::epsilon();
        for (std::size_t i = 0; i < mesh.vertexCount(); ++i) {
            const glm::dvec3 position = glm::dvec3(mesh.positions[i]) + (mesh.origin - shift);
            EXPECT_LE(glm::length(position - glm::dvec3(wanted.positions[i])), std::sqrt(3.0) * tolerance);
            EXPECT_EQ(mesh.normals[i], wanted.normals[i]);
        }
    }
}

}  // namespace
}  // namespace isoglass
