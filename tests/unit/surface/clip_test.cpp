#include "base/error.h"
#include "mesh/mesh_check.h"
#include "support/random_fields.h"
#include "support/terrain_lattice.h"
#include "surface_check.h"
#include "volume/analytic.h"

#include <glm/geometric.hpp>

#include <random>

namespace isoglass {
namespace {

struct Field {
    Lattice lattice;
    std::vector<float> samples;
    float iso;
};

/// Few integers: many samples equal the iso-value, many cells are ambiguous.
Field integerField(std::uint32_t seed) {
    Field field{makeUniformLattice({10, 9, 12}, {-3, 2, 0}, {1, 0.5, 2}), {}, 1};
    field.samples = randomIntegers(field.lattice.dims(), 3, seed);
    return field;
}

Field floatField(std::uint32_t seed) {
    Field field{makeUniformLattice({9, 11, 10}, {0, 0, 0}, {1, 1, 1}), {}, 0};
    field.samples = randomFloats(field.lattice.dims(), seed);
    return field;
}

/// Planes through samples along lattice directions, and anywhere.
CutPlane randomPlane(const Lattice& lattice, std::mt19937& random) {
    glm::dvec3 through, normal;
    const auto small = [&random] { return static_cast<double>(random() % 3) - 1; };
    const bool lattices = random() % 2 == 0;
    do {
        for (int k = 0; k < 3; ++k) {
            const Axis& axis = lattice.axes[k];
            const std::size_t i = random() % axis.size();
            through[k] = axis.coordinate(i);
            const double step = axis.coordinate(1) - axis.coordinate(0);
            if (!lattices) through[k] += step * (random() % 1024) / 1024.0;
            normal[k] = lattices ? small() / step : static_cast<double>(random() % 2001) - 1000;
        }
    } while (normal == glm::dvec3(0));
    return {{normal, -glm::dot(normal, through)}};
}

void expectClosed(const Extraction& extraction, const std::string& what) {
    ASSERT_EQ(extraction.capIdentity.size(), extraction.caps.vertexCount());
    const MeshTopology topology = checkTopology(joinCaps(extraction));
    EXPECT_EQ(topology.boundaryEdges, 0u) << what;
    EXPECT_EQ(topology.nonManifoldEdges, 0u) << what;
    EXPECT_EQ(topology.misorientedEdges, 0u) << what;
    EXPECT_EQ(topology.degenerateTriangles, 0u) << what;
    EXPECT_EQ(topology.unreferencedVertices, 0u) << what;
    std::size_t shared = 0;
    for (std::size_t i = 0; i < extraction.caps.vertexCount(); ++i) {
        const std::uint32_t identity = extraction.capIdentity[i];
        if (identity >= extraction.mesh.vertexCount()) continue;
        ++shared;
        ASSERT_EQ(extraction.caps.positions[i], extraction.mesh.positions[identity]) << what;
    }
    EXPECT_TRUE(shared > 0 || extraction.caps.empty() || extraction.mesh.empty()) << what;
}

TEST(Clip, TheDomainsEndClosesTheSurface) {
    for (std::uint32_t seed = 0; seed < 12; ++seed) {
        for (const Field& field : {integerField(seed), floatField(seed)}) {
            for (const bool below : {false, true}) {
                const Extraction closed = test::extractDense(
                    field.lattice, field.samples, {.iso = field.iso, .insideIsBelow = below, .closed = true});
                EXPECT_FALSE(closed.caps.empty());
                expectClosed(closed, "seed " + std::to_string(seed));
            }
        }
    }
}

TEST(Clip, MeshAndCapsAreClosedForAnyPlanes) {
    std::mt19937 random(1);
    for (std::uint32_t seed = 0; seed < 60; ++seed) {
        for (const Field& field : {integerField(seed), floatField(seed)}) {
            ExtractOptions options{.iso = field.iso, .insideIsBelow = seed % 2 == 1, .closed = true};
            const std::uint32_t count = 1 + random() % 6;
            for (std::uint32_t i = 0; i < count; ++i)
                options.clip.push_back(randomPlane(field.lattice, random));
            const Extraction extraction = test::extractDense(field.lattice, field.samples, options);
            expectClosed(extraction, "seed " + std::to_string(seed));
            EXPECT_EQ(measure(extraction.mesh).nonFiniteVertices, 0u);
            EXPECT_EQ(measure(extraction.caps).nonFiniteVertices, 0u);
        }
    }
}

double slackOf(const CutPlane& plane) {
    // Coordinates below 32, rounded to float.
    return 32 * glm::length(glm::dvec3(plane.plane)) * 3 * 0x1p-23;
}

TEST(Clip, NothingIsLeftBehindAPlaneAndCapsLieInIt) {
    std::mt19937 random(2);
    for (std::uint32_t seed = 0; seed < 30; ++seed) {
        const Field field = floatField(seed);
        const CutPlane plane = randomPlane(field.lattice, random);
        const Extraction cut =
            test::extractDense(field.lattice, field.samples, {.iso = field.iso, .clip = {plane}});
        for (const glm::vec3& position : cut.mesh.positions)
            ASSERT_GE(plane.distance(cut.mesh.origin + glm::dvec3(position)), -slackOf(plane));
        for (std::size_t i = 0; i < cut.caps.vertexCount(); ++i) {
            ASSERT_NEAR(plane.distance(cut.caps.origin + glm::dvec3(cut.caps.positions[i])), 0,
                        slackOf(plane));
            const double cosine =
                glm::dot(glm::dvec3(cut.caps.normals[i]), glm::normalize(glm::dvec3(plane.plane)));
            ASSERT_NEAR(cosine, -1, 1e-6);
        }
    }
}

/// Both sides of a cut together are the whole, and their caps are the same from both sides.
TEST(Clip, BothSidesOfAPlaneMakeTheWhole) {
    std::mt19937 random(3);
    for (std::uint32_t seed = 0; seed < 30; ++seed) {
        for (const Field& field : {integerField(seed), floatField(seed)}) {
            ExtractOptions options{.iso = field.iso, .closed = true};
            const double whole =
                measure(joinCaps(test::extractDense(field.lattice, field.samples, options))).volume;
            const CutPlane plane = randomPlane(field.lattice, random);
            const auto volume = [&](const CutPlane& side) {
                options.clip = {side};
                return measure(joinCaps(test::extractDense(field.lattice, field.samples, options))).volume;
            };
            const double sum = volume(plane) + volume({-plane.plane});
            // Positions of up to 32 rounded to float move an area of at most some thousand by 2e-6.
            EXPECT_NEAR(sum, whole, 5e-3) << "seed " << seed;
        }
    }
}

Extraction cutSphere(int count, const std::vector<CutPlane>& planes, int threads = 0) {
    const Lattice lattice = makeUnitLattice(count);
    return test::extractFrame(lattice, makeAnalyticFrame(lattice, growingSphere, 0),
                              {.iso = 0.3f, .threads = threads, .clip = planes});
}

TEST(Clip, AHalfBallHasItsVolumeAndADiskForACap) {
    const CutPlane plane{{0.3, -0.5, 0.8, 0}};
    const Extraction half = cutSphere(48, {plane});
    expectClosed(half, "half a ball");
    const MeshTopology topology = checkTopology(joinCaps(half));
    EXPECT_TRUE(topology.isOrientedManifold());
    EXPECT_EQ(topology.eulerNumber, 2);
    // Edges are at most the diagonal of a cell long, h = 2 / 47, so that everything lies within
    // 3 h^2 / (8 r) of the sphere.
    const double r = 0.7;
    const double h = 2.0 / 47;
    const double sagitta = 3 * h * h / (8 * r);
    EXPECT_NEAR(measure(joinCaps(half)).volume, 2.0 / 3 * M_PI * r * r * r, 2 * M_PI * r * r * sagitta);
    EXPECT_NEAR(measure(half.caps).area, M_PI * r * r, 2 * M_PI * r * sagitta);
    EXPECT_NEAR(measure(half.mesh).area, 2 * M_PI * r * r, 4 * M_PI * r * sagitta);
}

/// Caps on cells that the surface crosses may fold where the section is not convex: at most a few parts in
/// ten thousand of a smooth section.
TEST(Clip, CapsDoNotFoldOver) {
    std::mt19937 random(4);
    for (int trial = 0; trial < 10; ++trial) {
        const CutPlane plane = randomPlane(makeUnitLattice(33), random);
        const Extraction cut = cutSphere(33, {plane});
        if (cut.caps.empty()) continue;
        const glm::dvec3 outward = -glm::normalize(glm::dvec3(plane.plane));
        double area = 0, signedArea = 0;
        for (std::size_t t = 0; t < cut.caps.triangles.size(); t += 3) {
            const glm::dvec3 a(cut.caps.positions[cut.caps.triangles[t]]);
            const glm::dvec3 b(cut.caps.positions[cut.caps.triangles[t + 1]]);
            const glm::dvec3 c(cut.caps.positions[cut.caps.triangles[t + 2]]);
            const glm::dvec3 cross = glm::cross(b - a, c - a) * 0.5;
            area += glm::length(cross);
            signedArea += glm::dot(cross, outward);
        }
        EXPECT_NEAR(area, signedArea, 5e-4 * area);
    }
}

TEST(Clip, APlaneBeyondTheSurfaceChangesNoByte) {
    const Extraction whole = cutSphere(40, {});
    const Extraction kept = cutSphere(40, {{{1, 0, 0, 5}}, {{0, 1, 1, 3}}});
    EXPECT_TRUE(test::sameBytes(whole.mesh, kept.mesh));
    EXPECT_TRUE(kept.caps.empty());
}

TEST(Clip, BricksBehindAPlaneAreNotExtracted) {
    const Extraction whole = cutSphere(64, {});
    const Extraction half = cutSphere(64, {{{1, 0, 0, 0}}});
    const Extraction none = cutSphere(64, {{{1, 0, 0, -0.9}}});
    // The plane at sample 31.5 leaves the bricks 3 to 7 of 8, and with them those that lend vertices.
    EXPECT_LT(half.stats.touchedBricks, whole.stats.touchedBricks * 3 / 4);
    EXPECT_EQ(none.stats.touchedBricks, 0u);
    EXPECT_TRUE(none.mesh.empty());
    EXPECT_TRUE(none.caps.empty());
    EXPECT_EQ(none.mesh.vertexCount(), 0u);
}

TEST(Clip, ACutThatIsNotCappedStaysOpen) {
    const Extraction open = cutSphere(40, {{{0.2, 1, 0, 0}, false}});
    EXPECT_TRUE(open.caps.empty());
    EXPECT_GT(checkTopology(open.mesh).boundaryEdges, 0u);
    EXPECT_TRUE(test::sameBytes(open.mesh, cutSphere(40, {{{0.2, 1, 0, 0}, true}}).mesh));
}

TEST(Clip, SamePlaneTwiceIsOne) {
    const CutPlane plane{{0.3, -0.5, 0.8, 0.1}};
    const Extraction twice = cutSphere(32, {plane, plane});
    expectClosed(twice, "twice");
    EXPECT_NEAR(measure(joinCaps(twice)).volume, measure(joinCaps(cutSphere(32, {plane}))).volume, 1e-5);
}

TEST(Clip, OppositePlanesLeaveAlmostNothing) {
    const glm::dvec4 plane(0.3, -0.5, 0.8, 0.1);
    const Extraction thin = cutSphere(32, {{plane}, {-plane}});
    expectClosed(thin, "thin");
    // Between the two there is what rounding leaves: a disk of 1.5 square units, 1e-6 thick.
    EXPECT_NEAR(measure(joinCaps(thin)).volume, 0, 1e-5);
}

TEST(Clip, SameBytesForAnyNumberOfThreads) {
    const std::vector<CutPlane> planes{{{0.3, -0.5, 0.8, 0.1}}, {{1, 0, 0, 0.2}}, {{0, -1, 0.1, 0.3}}};
    const Extraction one = cutSphere(40, planes, 1);
    for (const int threads : {2, 5}) {
        const Extraction more = cutSphere(40, planes, threads);
        EXPECT_TRUE(test::sameBytes(one.mesh, more.mesh));
        EXPECT_TRUE(test::sameBytes(one.caps, more.caps));
        EXPECT_EQ(one.capIdentity, more.capIdentity);
    }
}

/// Descending and uneven axes mirror and stretch; the volume stays positive and the mesh closed.
TEST(Clip, UnevenAndMirroredAxesAreClosedToo) {
    std::mt19937 random(5);
    for (std::uint32_t seed = 0; seed < 12; ++seed) {
        Field field = floatField(seed);
        for (int k = 0; k < 3; ++k) {
            double at = 3;
            for (double& coordinate : field.lattice.axes[k].coordinates) {
                coordinate = seed >> k & 1 ? -at : at;
                at += 0.2 + 0.3 * (random() % 4);
            }
        }
        const Extraction cut = test::extractDense(
            field.lattice, field.samples,
            {.iso = field.iso, .clip = {randomPlane(field.lattice, random)}, .closed = true});
        expectClosed(cut, "seed " + std::to_string(seed));
        EXPECT_TRUE(cut.caps.empty() || measure(joinCaps(cut)).volume > 0) << seed;
    }
}

TEST(Clip, WorksBetweenKeyFrames) {
    const Field a = floatField(1);
    const Field b = floatField(2);
    const TimedField field{makeKeyFrame(a.lattice, a.samples), makeKeyFrame(b.lattice, b.samples), 0.3f};
    const ExtractOptions options{.iso = 0, .clip = {{{1, 2, 3, -25}}}, .closed = true};
    const Extraction between = extractSurface(a.lattice, field, options);
    expectClosed(between, "between");
    const auto dense = test::interpolated(a.samples, b.samples, 0.3f);
    const Extraction same = test::extractDense(a.lattice, dense, options);
    EXPECT_TRUE(test::sameBytes(between.mesh, same.mesh));
    EXPECT_TRUE(test::sameBytes(between.caps, same.caps));
}

/// Along a periodic axis the domain has no end to cap.
TEST(Clip, PeriodicAxesHaveNoEndToCap) {
    Field field = floatField(3);
    field.lattice.axes[0].period = static_cast<double>(field.lattice.axes[0].size());
    const Extraction closed =
        test::extractDense(field.lattice, field.samples, {.iso = field.iso, .closed = true});
    for (const glm::vec3& normal : closed.caps.normals) EXPECT_EQ(normal.x, 0);
    EXPECT_FALSE(closed.caps.empty());
}

/// Missing samples leave holes, in caps as in the surface, and nothing worse.
TEST(Clip, MissingSamplesOnlyOpenTheMesh) {
    for (std::uint32_t seed = 0; seed < 20; ++seed) {
        Field field = integerField(seed);
        removeSamples(field.samples, 5, seed);
        const Extraction cut = test::extractDense(
            field.lattice, field.samples, {.iso = field.iso, .clip = {{{1, 1, 1, -8}}}, .closed = true});
        const MeshTopology topology = checkTopology(joinCaps(cut));
        EXPECT_EQ(topology.nonManifoldEdges, 0u);
        EXPECT_EQ(topology.misorientedEdges, 0u);
        EXPECT_EQ(measure(cut.caps).nonFiniteVertices, 0u);
    }
}

/// Where the levels follow heights of their own the cells are no boxes: refused, not cut wrongly.
TEST(Clip, RefusesSamplesWithHeightsOfTheirOwn) {
    const test::TerrainLattice terrain({5, 5, 5});
    const auto samples = randomFloats(terrain.lattice.dims(), 1);
    const auto frame = makeKeyFrame(terrain.lattice, samples, terrain.heights(0));
    EXPECT_THROW(test::extractFrame(terrain.lattice, frame, {.clip = {{{1, 0, 0, 0}}}}), Error);
    EXPECT_THROW(test::extractFrame(terrain.lattice, frame, {.closed = true}), Error);
    EXPECT_NO_THROW(test::extractFrame(terrain.lattice, frame, {}));
}

}  // namespace
}  // namespace isoglass
