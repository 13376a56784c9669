#include "mesh/mesh_check.h"
#include "unit/surface/surface_check.h"
#include "volume/analytic.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <numbers>

namespace isoglass {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kUlp = std::numeric_limits<float>::epsilon();

/// A sphere and the lattice spacing that it is sampled with.
struct Sphere {
    glm::dvec3 centre{0};
    double radius = 0.7;
    double spacing = 0;
    SurfaceMesh mesh;
};

SurfaceMesh extractSphere(const Lattice& lattice, glm::dvec3 centre, double radius) {
    const auto field = [&](glm::dvec3 p, double) {
        return static_cast<float>(radius - glm::length(p - centre));
    };
    return test::extractFrame(lattice, makeAnalyticFrame(lattice, field, 0), {.iso = 0}).mesh;
}

Sphere growingSphereAt(int samples) {
    const Lattice lattice = makeUnitLattice(samples);
    return {
        .spacing = 2.0 / (samples - 1),
        .mesh =
            test::extractFrame(lattice, makeAnalyticFrame(lattice, growingSphere, 0), {.iso = 0.3f}).mesh};
}

/// Centred where no symmetry of the lattice helps, with a radius that is no multiple of anything.
Sphere oddSphereAt(int samples) {
    const glm::dvec3 centre(0.1234, -0.0871, 0.0519);
    return {.centre = centre,
            .radius = 0.6137,
            .spacing = 2.0 / (samples - 1),
            .mesh = extractSphere(makeUnitLattice(samples), centre, 0.6137)};
}

/// Distance of every vertex from the true sphere.
std::vector<double> distances(const Sphere& sphere) {
    std::vector<double> result;
    for (const glm::vec3& position : sphere.mesh.positions) {
        const glm::dvec3 world = glm::dvec3(position) + sphere.mesh.origin;
        result.push_back(std::abs(glm::length(world - sphere.centre) - sphere.radius));
    }
    return result;
}

double rootMeanSquare(const std::vector<double>& values) {
    double sum = 0;
    for (const double value : values) sum += value * value;
    return std::sqrt(sum / static_cast<double>(values.size()));
}

// Along an edge of length h in direction u the field R - |x| has the second derivative -(1 - (u.n)^2)/|x|,
// at most 1/(R-h) since both ends of a crossed edge lie within h of the sphere. A linear interpolant is
// off by at most h^2/8 times that; at the vertex it is the iso-value, so the field itself, which is the
// distance from the sphere, is at most h^2/(8(R-h)) off. Samples below 2 in magnitude are rounded by at
// most an ulp of 1, and so are the vertex' three coordinates.
TEST(ExtractSphere, EveryVertexIsWithinTheChordBound) {
    for (const int samples : {17, 32, 33, 64, 65, 129}) {
        for (const Sphere& sphere : {growingSphereAt(samples), oddSphereAt(samples)}) {
            ASSERT_GT(sphere.mesh.vertexCount(), 0u);
            const double h = sphere.spacing;
            const double bound = h * h / (8 * (sphere.radius - h)) + 3 * kUlp;
            const auto found = distances(sphere);
            EXPECT_LE(*std::ranges::max_element(found), bound) << samples << " samples";
        }
    }
}

// Error = c h^2 + O(h^3) with c averaged over the sphere: halving h divides it by 4, up to a part of
// order h/R = 0.045, which is below 0.1 in the exponent of 2.
TEST(ExtractSphere, HalvingTheSpacingQuartersTheError) {
    for (const auto& make : {growingSphereAt, oddSphereAt}) {
        const double before = rootMeanSquare(distances(make(65)));
        const double after = rootMeanSquare(distances(make(129)));
        EXPECT_NEAR(std::log2(before / after), 2, 0.1);
        // The largest error is attained in the middle of an edge that touches the sphere; the finer
        // lattice may come closer to one, by at most the bound's own h/R.
        const auto coarse = distances(make(65));
        const auto fine = distances(make(129));
        EXPECT_NEAR(std::log2(*std::ranges::max_element(coarse) / *std::ranges::max_element(fine)), 2, 0.15);
    }
}

TEST(ExtractSphere, IsAClosedOrientedManifoldWithEulerNumberTwo) {
    for (const int samples : {9, 17, 32, 64, 65}) {
        for (const Sphere& sphere : {growingSphereAt(samples), oddSphereAt(samples)}) {
            const MeshTopology topology = checkTopology(sphere.mesh);
            EXPECT_TRUE(topology.isOrientedManifold()) << samples;
            EXPECT_TRUE(topology.isClosed()) << samples;
            EXPECT_EQ(topology.components, 1u) << samples;
            EXPECT_EQ(topology.eulerNumber, 2) << samples;
            EXPECT_EQ(topology.unreferencedVertices, 0u) << samples;
        }
    }
}

// Vertices lie within e = h^2/(8(R-h)) of the sphere. A point p = sum w_i v_i of a triangle has
// |p|^2 = sum w_i |v_i|^2 - sum w_i |v_i - p|^2, and the last sum is at most the squared radius of a circle
// around the triangle: h^2, since its corners share a cell of diagonal sqrt(3) h (Jung). So the mesh stays
// within d = e + h^2/(2(R-h)) of the sphere. Both errors are c h^2 with O(h/R) beside, see above.
TEST(ExtractSphere, VolumeAndAreaConvergeWithSecondOrder) {
    for (const auto& make : {growingSphereAt, oddSphereAt}) {
        std::array<double, 2> volumeError{};
        std::array<double, 2> areaError{};
        for (const int i : {0, 1}) {
            const Sphere sphere = make(i == 0 ? 65 : 129);
            const MeshMeasures measures = measure(sphere.mesh);
            const double r = sphere.radius;
            volumeError[i] = std::abs(measures.volume - 4.0 / 3 * kPi * r * r * r);
            areaError[i] = std::abs(measures.area - 4 * kPi * r * r);
            const double h = sphere.spacing;
            const double d = h * h / (8 * (r - h)) + h * h / (2 * (r - h));
            EXPECT_LE(volumeError[i], 4 * kPi * r * r * d);
        }
        EXPECT_NEAR(std::log2(volumeError[0] / volumeError[1]), 2, 0.1);
        EXPECT_NEAR(std::log2(areaError[0] / areaError[1]), 2, 0.1);
    }
}

TEST(ExtractSphere, SameBytesForAnyNumberOfThreads) {
    const Lattice lattice = makeUnitLattice(65);
    const auto a = makeAnalyticFrame(lattice, growingSphere, 0);
    const auto b = makeAnalyticFrame(lattice, blobs, 0);
    for (const float fraction : {0.0f, 0.37f}) {
        const auto run = [&](int threads) {
            return extractSurface(lattice, {a, b, fraction}, {.iso = 0.3f, .threads = threads}).mesh;
        };
        const SurfaceMesh one = run(1);
        ASSERT_GT(one.triangleCount(), 1000u);
        for (const int threads : {2, 3, 7, 0}) EXPECT_TRUE(test::sameBytes(one, run(threads))) << threads;
    }
}

// With c = u.n the field R - |x| has third derivatives 3c(1-c^2)/|x|^2 along u, at most (2/sqrt 3)/|x|^2,
// so a central difference is off by (h^2/6)(2/sqrt 3)/(R-2h)^2, the vector of three by sqrt 3 times that:
// (h^2/3)/(R-2h)^2. Interpolating the unit vector x/|x| along the edge adds h^2/8 times its second
// derivative, at most (2/sqrt 3)/|x|^2: 0.145 h^2/(R-h)^2. A vector within E of a unit vector makes an
// angle with it of at most asin(E). Rounding: samples near the surface are below 1, their differences
// are off by an ulp of 1, over 2h, in three components.
TEST(ExtractSphere, NormalsPointOutwardWithinTheDerivedAngle) {
    for (const int samples : {33, 65, 129}) {
        for (const Sphere& sphere : {growingSphereAt(samples), oddSphereAt(samples)}) {
            const double h = sphere.spacing;
            const double reach = sphere.radius - 2 * h;
            const double bound = (1.0 / 3 + 0.145) * h * h / (reach * reach) + std::sqrt(3.0) * kUlp / h;
            double largest = 0;
            for (std::size_t i = 0; i < sphere.mesh.vertexCount(); ++i) {
                const glm::dvec3 radial =
                    glm::normalize(glm::dvec3(sphere.mesh.positions[i]) + sphere.mesh.origin - sphere.centre);
                const glm::dvec3 normal(sphere.mesh.normals[i]);
                ASSERT_GT(glm::dot(radial, normal), 0);
                EXPECT_NEAR(glm::length(normal), 1, bound) << "minus the gradient of a distance";
                largest = std::max(largest, glm::length(glm::cross(radial, glm::normalize(normal))));
            }
            EXPECT_LE(largest, bound) << samples << " samples";
        }
    }
}

}  // namespace
}  // namespace isoglass
