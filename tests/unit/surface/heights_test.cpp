#include "mesh/mesh_check.h"
#include "support/random_fields.h"
#include "support/terrain_lattice.h"
#include "unit/mesh_io/scratch_folder.h"
#include "unit/surface/surface_check.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cstdlib>
#include <numbers>
#include <stdexcept>

namespace isoglass {
namespace {

using test::sameBytes;
using test::TerrainLattice;

constexpr double kUlp = std::numeric_limits<float>::epsilon();

/// Two key frames on a moving terrain, and the field a . X + c at their samples.
struct LinearSeries {
    TerrainLattice terrain;
    glm::dvec3 slope;
    double offset = 0.3;
    TimedField field;

    double value(glm::dvec3 p) const { return glm::dot(slope, p) + offset; }

    LinearSeries(glm::ivec3 dims, int mirror, glm::dvec3 slope_, float fraction, std::uint32_t missing = 0)
        : terrain(dims, mirror), slope(slope_) {
        field = {frameAt(0, missing), frameAt(0.8, missing), fraction};
    }

  private:
    std::shared_ptr<const KeyFrame> frameAt(double time, std::uint32_t missing) const {
        const std::vector<float> heights = terrain.heights(time);
        std::vector<float> samples = terrain.sample(heights, [&](glm::dvec3 p) { return value(p); });
        removeSamples(samples, missing, 7);
        return makeKeyFrame(terrain.lattice, samples, heights);
    }
};

/// Bounds for a linear field, of which extraction is exact but for rounding. F, X: largest magnitude of the
/// field and of a coordinate, a: the slope. A sample carries half an ulp of F, and interpolation in time 2.5
/// more (twice the difference of two, and their sum); heights 2.5 of X; a position is rounded once.
struct LinearBounds {
    static constexpr double kLargest = 4.4;  ///< coordinates stay below
    double value;                            ///< of |f(vertex) - iso|
    double normal;                           ///< of any component

    LinearBounds(const LinearSeries& series) {
        const glm::dvec3 a = glm::abs(series.slope);
        const double largestValue = (a.x + a.y + a.z) * kLargest + series.offset;
        const double sampleError = (3 * largestValue + 2.5 * a.z * kLargest) * kUlp;
        value = sampleError + 0.5 * (a.x + a.y + a.z) * kLargest * kUlp;
        // A difference of two samples over a step, twice that for central differences on uneven steps. The
        // ground is at most 1.3 * 0.5 steep, twice that over the uneven steps of its differences. A few
        // ulp are those of the quotients themselves.
        const double columnError = 2 * sampleError / smallestColumnStep(series);
        const double rowError = 4 * sampleError / smallestRowStep(series);
        normal = rowError + 1.3 * columnError + 16 * kUlp * (a.x + a.y + 2 * a.z);
    }

  private:
    static double smallestColumnStep(const LinearSeries& series) {
        const auto& terrain = series.terrain;
        const auto levels = static_cast<double>(terrain.lattice.axes[2].size() - 1);
        // The lowest step is the smallest; the ground is at most at 0.3, so 1.7 lie above it.
        return std::pow(1 / levels, 1.3) * 1.7;
    }
    static double smallestRowStep(const LinearSeries& series) {
        double smallest = 1;
        for (int k = 0; k < 2; ++k) {
            const auto& c = series.terrain.lattice.axes[k].coordinates;
            for (std::size_t i = 1; i < c.size(); ++i)
                smallest = std::min(smallest, std::abs(c[i] - c[i - 1]));
        }
        return smallest;
    }
};

void expectPlane(const LinearSeries& series, bool below) {
    const LinearBounds bounds(series);
    const float iso = 1.25f;
    const Extraction found = extractSurface(series.terrain.lattice, series.field,
                                            {.iso = iso, .insideIsBelow = below, .threads = 1});
    ASSERT_GT(found.mesh.vertexCount(), 100u);
    const glm::dvec3 wanted = below ? series.slope : -series.slope;
    double valueError = 0;
    double normalError = 0;
    for (std::size_t i = 0; i < found.mesh.vertexCount(); ++i) {
        const glm::dvec3 position = glm::dvec3(found.mesh.positions[i]) + found.mesh.origin;
        valueError = std::max(valueError, std::abs(series.value(position) - iso));
        const glm::dvec3 difference = glm::abs(glm::dvec3(found.mesh.normals[i]) - wanted);
        normalError = std::max({normalError, difference.x, difference.y, difference.z});
    }
    EXPECT_LE(valueError, bounds.value);
    EXPECT_LE(normalError, bounds.normal);
    const MeshTopology topology = checkTopology(found.mesh);
    EXPECT_EQ(topology.nonManifoldEdges, 0u);
    EXPECT_EQ(topology.misorientedEdges, 0u);
    // Counter-clockwise seen from outside: the geometric normal goes with the field's.
    const auto& m = found.mesh;
    glm::dvec3 area(0);
    for (std::size_t t = 0; t < m.triangles.size(); t += 3) {
        const glm::dvec3 a(m.positions[m.triangles[t]]);
        area += glm::cross(glm::dvec3(m.positions[m.triangles[t + 1]]) - a,
                           glm::dvec3(m.positions[m.triangles[t + 2]]) - a);
    }
    EXPECT_GT(glm::dot(area, wanted), 0.99 * glm::length(area) * glm::length(wanted))
        << "all lie in one plane";
}

// In one plane, with its normal, wherever the samples lie: at a key frame and between two, at the ends of the
// domain, in all eight orientations of the axes.
TEST(ExtractHeights, LinearFieldGivesItsPlaneUnderAnyMapping) {
    for (int mirror = 0; mirror < 8; ++mirror) {
        for (const float fraction : {0.0f, 0.37f, 1.0f}) {
            SCOPED_TRACE(testing::Message() << "mirror " << mirror << ", fraction " << fraction);
            expectPlane({{21, 18, 19}, mirror, {0.31, -0.22, 0.87}, fraction}, false);
            expectPlane({{21, 18, 19}, mirror, {0.0, 0.0, 1.0}, fraction}, true);
        }
    }
}

// One-sided differences take the same neighbours of field and heights, so that holes change nothing.
TEST(ExtractHeights, LinearFieldGivesItsPlaneBesideMissingSamples) {
    for (const float fraction : {0.0f, 0.6f}) {
        const LinearSeries series({25, 26, 19}, 0, {0.5, 0.4, 0.7}, fraction, 4);
        const LinearBounds bounds(series);
        const Extraction found = extractSurface(series.terrain.lattice, series.field, {.iso = 1.25f});
        EXPECT_GT(found.stats.lostCells, 0u);
        ASSERT_GT(found.mesh.vertexCount(), 100u);
        std::size_t lonely = 0;
        for (std::size_t i = 0; i < found.mesh.vertexCount(); ++i) {
            const glm::dvec3 position = glm::dvec3(found.mesh.positions[i]) + found.mesh.origin;
            EXPECT_LE(std::abs(series.value(position) - 1.25), bounds.value);
            // A sample without any neighbour along an axis has no derivative there.
            const glm::dvec3 difference = glm::abs(glm::dvec3(found.mesh.normals[i]) + series.slope);
            lonely += std::max({difference.x, difference.y, difference.z}) > bounds.normal;
        }
        // Both neighbours along one of three axes missing, at one of two ends: 2 * 3 * 0.04^2 or 1 %; less
        // at the ends of the domain does not weigh.
        EXPECT_LT(static_cast<double>(lonely), 0.02 * static_cast<double>(found.mesh.vertexCount()));
    }
}

struct SphereErrors {
    double distance = 0;
    double angle = 0;
    double longestChord = 0;  ///< between two corners of a cell
    MeshTopology topology;
    double volume = 0;
};

constexpr glm::dvec3 kCentre(2.03, 1.46, 1.02);
constexpr double kRadius = 0.8;

/// Longest distance between two corners of a cell.
double longestChord(const Lattice& lattice, const std::vector<float>& heights) {
    const glm::ivec3 dims = lattice.dims();
    const auto world = [&](glm::ivec3 i) {
        return glm::dvec3(lattice.axes[0].coordinates[i.x], lattice.axes[1].coordinates[i.y],
                          heights[sampleAt(dims, i)]);
    };
    double longest = 0;
    for (int z = 0; z + 1 < dims.z; ++z)
        for (int y = 0; y + 1 < dims.y; ++y)
            for (int x = 0; x + 1 < dims.x; ++x)
                for (int a = 0; a < 8; ++a)
                    for (int b = 0; b < a; ++b) {
                        const glm::ivec3 low(x, y, z);
                        const glm::dvec3 chord = world(low + glm::ivec3(a & 1, a >> 1 & 1, a >> 2)) -
                                                 world(low + glm::ivec3(b & 1, b >> 1 & 1, b >> 2));
                        longest = std::max(longest, glm::length(chord));
                    }
    return longest;
}

SphereErrors extractSphere(int cells, int mirror) {
    const TerrainLattice terrain({4 * cells + 1, 3 * cells + 1, 2 * cells + 1}, mirror);
    const std::vector<float> heights = terrain.heights(0);
    const std::vector<float> samples =
        terrain.sample(heights, [](glm::dvec3 p) { return kRadius - glm::length(p - kCentre); });
    const SurfaceMesh mesh =
        test::extractFrame(terrain.lattice, makeKeyFrame(terrain.lattice, samples, heights), {.iso = 0}).mesh;
    SphereErrors errors;
    errors.topology = checkTopology(mesh);
    errors.volume = measure(mesh).volume;
    for (std::size_t i = 0; i < mesh.vertexCount(); ++i) {
        const glm::dvec3 radial = glm::dvec3(mesh.positions[i]) + mesh.origin - kCentre;
        const glm::dvec3 outward = glm::normalize(radial);
        const glm::dvec3 normal = glm::normalize(glm::dvec3(mesh.normals[i]));
        errors.distance = std::max(errors.distance, std::abs(glm::length(radial) - kRadius));
        errors.angle = std::max(errors.angle, std::acos(std::min(1.0, glm::dot(outward, normal))));
    }
    errors.longestChord = longestChord(terrain.lattice, heights);
    return errors;
}

// A vertex lies on a straight world edge no longer than a cell's longest chord L, where linear interpolation
// is off by L^2/8 times the second derivative of the distance, at most 1/r with r >= R - L; the distance has
// slope 1. A triangle of a cell lies at most L^2/6R below a sphere through its corners (circumradius L/sqrt
// 3).
TEST(ExtractHeights, SphereErrorIsWithinTheChordBound) {
    for (const int cells : {8, 16}) {
        for (int mirror = 0; mirror < 8; ++mirror) {
            SCOPED_TRACE(testing::Message() << cells << " cells, mirror " << mirror);
            const SphereErrors errors = extractSphere(cells, mirror);
            const double squared = errors.longestChord * errors.longestChord;
            const double bound = squared / 8 / (kRadius - errors.longestChord);
            EXPECT_LE(errors.distance, bound);
            EXPECT_TRUE(errors.topology.isOrientedManifold());
            EXPECT_TRUE(errors.topology.isClosed());
            EXPECT_EQ(errors.topology.components, 1u);
            EXPECT_EQ(errors.topology.eulerNumber, 2);
            // Three times the relative error of the radius; negative where the winding were inward.
            const double whole = 4.0 / 3 * std::numbers::pi * kRadius * kRadius * kRadius;
            EXPECT_NEAR(errors.volume, whole, whole * 3 * (bound + squared / 6 / kRadius) / kRadius);
        }
    }
}

// Differences of second order on smooth steps: half the cells, a quarter of the angle; 3 leaves room for what
// the next order adds.
TEST(ExtractHeights, NormalsConvergeToTheAnalyticGradient) {
    const double coarse = extractSphere(8, 0).angle;
    const double middle = extractSphere(16, 0).angle;
    const double fine = extractSphere(32, 0).angle;
    EXPECT_LT(middle, coarse / 3);
    EXPECT_LT(fine, middle / 3);
    EXPECT_LT(fine, 0.01);
}

TEST(ExtractHeights, LevelsInTheAxisTableGiveTheSamePositions) {
    const glm::ivec3 dims(19, 13, 22);
    Lattice flat = makeUniformLattice(dims, {1, 2, 3}, {0.5, 0.25, 2});
    const std::vector<float> samples = randomFloats(dims, 11);
    const SurfaceMesh wanted = test::extractDense(flat, samples, {.iso = 0.1f}).mesh;
    std::vector<float> heights;
    for (int z = 0; z < dims.z; ++z)
        heights.insert(heights.end(), static_cast<std::size_t>(dims.x) * dims.y,
                       static_cast<float>(3 + 2 * z));
    flat.heights = HeightField{"z", "", 3, 3.0 + 2 * (dims.z - 1)};
    const SurfaceMesh found =
        test::extractFrame(flat, makeKeyFrame(flat, samples, heights), {.iso = 0.1f}).mesh;
    EXPECT_EQ(found.triangles, wanted.triangles);
    EXPECT_EQ(found.positions, wanted.positions) << "every height is the table's, exactly";
    // Quotients of differences instead of products with an inverse: a few ulp of the largest, 2 / 0.25.
    for (std::size_t i = 0; i < wanted.vertexCount(); ++i) {
        const glm::vec3 difference = glm::abs(found.normals[i] - wanted.normals[i]);
        ASSERT_LE(std::max({difference.x, difference.y, difference.z}), 8 * kUlp * 8);
    }
}

TEST(ExtractHeights, MoveVerticesButNotTheGraph) {
    const glm::ivec3 dims(30, 17, 25);
    for (const std::uint32_t missing : {0u, 10u}) {
        TerrainLattice terrain(dims);
        std::vector<float> samples = randomIntegers(dims, 5, 3);
        removeSamples(samples, missing, 5);
        const auto frame = makeKeyFrame(terrain.lattice, samples, terrain.heights(0));
        const Extraction found = test::extractFrame(terrain.lattice, frame, {.iso = 2});
        Lattice flat = terrain.lattice;
        flat.heights.reset();
        const Extraction wanted = test::extractDense(flat, samples, {.iso = 2});
        EXPECT_EQ(found.mesh.triangles, wanted.mesh.triangles);
        EXPECT_EQ(found.stats.lostCells, wanted.stats.lostCells);
        EXPECT_EQ(measure(found.mesh).nonFiniteVertices, 0u);
        for (const glm::vec3& normal : found.mesh.normals) ASSERT_GT(glm::length(normal), 0);
    }
}

TEST(ExtractHeights, SameBytesForAnyNumberOfThreads) {
    const glm::ivec3 dims(70, 60, 40);
    const TerrainLattice terrain(dims);
    const auto a = makeKeyFrame(terrain.lattice, randomFloats(dims, 1), terrain.heights(0));
    const auto b = makeKeyFrame(terrain.lattice, randomFloats(dims, 2), terrain.heights(1));
    const auto mesh = [&](int threads) {
        return extractSurface(terrain.lattice, {a, b, 0.4f}, {.iso = 0.2f, .threads = threads}).mesh;
    };
    const SurfaceMesh one = mesh(1);
    ASSERT_GT(one.triangleCount(), 100'000u) << "more than one chunk of work";
    for (const int threads : {2, 3, 0}) EXPECT_TRUE(sameBytes(one, mesh(threads))) << threads << " threads";
}

TEST(ExtractHeights, ComeAtFullResolutionForEveryView) {
    const LinearSeries series({40, 37, 33}, 0, {0.2, 0.3, 0.6}, 0.5f);
    const Lattice& lattice = series.terrain.lattice;
    const View far{.eye = glm::dvec3(1000), .pixelsPerUnit = 100, .cellPixels = 4};
    ASSERT_TRUE(far.wantsDetail());
    EXPECT_TRUE(sameBytes(extractSurface(lattice, series.field, {.iso = 1.25f}).mesh,
                          extractSurface(lattice, series.field, {.iso = 1.25f, .view = far}).mesh));
}

TEST(ExtractHeights, StayInsideTheBounds) {
    const LinearSeries series({21, 18, 19}, 0, {0.9, 0.1, 0.2}, 0.5f);
    Lattice lattice = series.terrain.lattice;
    lattice.heights->min = series.field.a->heights()->range(0).min;
    lattice.heights->max = lattice.heights->min;
    for (const auto& frame : {series.field.a, series.field.b}) {
        for (std::size_t brick = 0; brick < frame->brickCount(); ++brick) {
            lattice.heights->min = std::min<double>(lattice.heights->min, frame->heights()->range(brick).min);
            lattice.heights->max = std::max<double>(lattice.heights->max, frame->heights()->range(brick).max);
        }
    }
    const auto [low, high] = lattice.bounds();
    EXPECT_LT(low.z, -0.3);
    EXPECT_EQ(high.z, 2);
    for (const glm::vec3& position : extractSurface(lattice, series.field, {.iso = 1.25f}).mesh.positions) {
        // A position is rounded once.
        ASSERT_GE(position.z, low.z - 4 * kUlp);
        ASSERT_LE(position.z, high.z + 4 * kUlp);
    }
}

TEST(ExtractHeights, LongitudeThatClosesHasNoSeam) {
    Lattice lattice = makeUniformLattice({36, 9, 12}, glm::dvec3(0), {10, 1, 1});
    lattice.axes[0].period = 360;
    lattice.heights = HeightField{"z", "", 0, 20};
    std::vector<float> heights;
    std::vector<float> samples;
    for (int z = 0; z < 12; ++z)
        for (int y = 0; y < 9; ++y)
            for (int x = 0; x < 36; ++x) {
                heights.push_back(static_cast<float>(
                    z * (1.2 + 0.3 * std::sin(x * 10 * std::numbers::pi / 180) + 0.01 * y)));
                samples.push_back(heights.back());
            }
    const SurfaceMesh mesh =
        test::extractFrame(lattice, makeKeyFrame(lattice, samples, heights), {.iso = 5.5f}).mesh;
    const MeshTopology topology = checkTopology(mesh);
    EXPECT_EQ(topology.components, 1u);
    // The level surface of the height itself: flat, with one normal, also where the circle closes. Rounding:
    // 20 ulp of heights over steps of at least 0.9, times the slope along x.
    for (std::size_t i = 0; i < mesh.vertexCount(); ++i) {
        ASSERT_NEAR(mesh.positions[i].z, 5.5, 20 * kUlp);
        ASSERT_LE(glm::length(mesh.normals[i] - glm::vec3(0, 0, -1)), 100 * kUlp);
    }
}

// The hurricane's wind of 35 m/s, from a forecast on staggered, terrain-following levels.
TEST(ExtractHeights, WindOfTheForecastIsAManifoldInsideItsBounds) {
    const char* data = std::getenv("ISOGLASS_DATA");
    if (!data) GTEST_SKIP() << "ISOGLASS_DATA is not set";
    const ScratchFolder folder;
    const auto source = openNetcdf(std::filesystem::path(data) / "katrina" / "mercator_sample.nc",
                                   {"sqrt(U^2 + V^2)", {}, "(PH + PHB) / 9.81"});
    const SeriesDescription series = writeSeries(*source, folder / "speed.vdb");
    const SeriesFile file(folder / "speed.vdb");
    const SurfaceMesh mesh =
        extractSurface(series.lattice, {file.read(0), file.read(1), 0.25f}, {.iso = 35}).mesh;
    ASSERT_GT(mesh.triangleCount(), 500u);
    EXPECT_TRUE(checkTopology(mesh).isOrientedManifold());
    const auto [low, high] = series.lattice.bounds();
    const auto found = measure(mesh).bounds;
    const double tolerance = test::positionTolerance(series.lattice, mesh.origin);
    for (int k = 0; k < 3; ++k) {
        EXPECT_GE(found[0][k] + mesh.origin[k], low[k] - tolerance);
        EXPECT_LE(found[1][k] + mesh.origin[k], high[k] + tolerance);
    }
    // Strong wind reaches from near the sea to the cut at the highest level.
    EXPECT_LT(found[0].z + mesh.origin.z, 200);
    EXPECT_GT(found[1].z + mesh.origin.z, 5000);
}

TEST(ExtractHeights, LatticeAndKeyFramesMustAgree) {
    const TerrainLattice terrain({9, 9, 9});
    const std::vector<float> heights = terrain.heights(0);
    const auto with = makeKeyFrame(terrain.lattice, heights, heights);
    const auto without = makeKeyFrame(terrain.lattice, heights);
    Lattice flat = terrain.lattice;
    flat.heights.reset();
    EXPECT_THROW(extractSurface(terrain.lattice, {without, nullptr, 0}, {}), std::invalid_argument);
    EXPECT_THROW(extractSurface(terrain.lattice, {with, without, 0.5f}, {}), std::invalid_argument);
    EXPECT_THROW(extractSurface(flat, {with, nullptr, 0}, {}), std::invalid_argument);
}

}  // namespace
}  // namespace isoglass
