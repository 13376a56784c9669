#include "mesh/mesh_check.h"
#include "support/mesh_boundary.h"
#include "surface/extract.h"
#include "unit/levels/level_case.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>

namespace isoglass {
namespace {

using test::Kind;
using test::LevelCase;

struct Selected {
    LevelSpace space;
    SizeField sizes;
    LevelFields fields;
    std::vector<LevelBrick> bricks;

    explicit Selected(const LevelCase& c)
        : space(c.lattice),
          sizes(space, *c.options.view, missingIn(c.field)),
          fields{space, sizes, fieldsOfLevels(space, c.field), c.options.insideIsBelow ? -1.0f : 1.0f},
          bricks(selectBricks(space, sizes, fields.fields, c.options.iso)) {}
    Selected(const Selected&) = delete;
};

/// Vertices of one key that differ in a bit of position or normal.
std::size_t unequalVertices(const std::vector<MeshPart>& parts) {
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

/// Boundary edges that lie neither in a face of the domain nor in a cell that lacks a sample.
std::size_t strayBoundaryEdges(const LevelCase& c, const SurfaceMesh& mesh) {
    const glm::ivec3 dims = c.lattice.dims();
    // A vertex where the domain cuts an edge is a mean of two vertices: three roundings of half an ulp of
    // the largest coordinate.
    const double tolerance = 1.5 * std::numeric_limits<float>::epsilon() * std::max({dims.x, dims.y, dims.z});
    const auto isMissing = [&](glm::ivec3 i) {
        const std::size_t place = (static_cast<std::size_t>(i.z) * dims.y + i.y) * dims.x + i.x;
        return (c.field.fraction < 1 && std::isnan(c.samples[0][place])) ||
               (c.field.fraction > 0 && std::isnan(c.samples[1][place]));
    };
    std::size_t stray = 0;
    for (const auto& edge : test::boundaryEdges(mesh)) {
        const glm::dvec3 a(mesh.positions[edge[0]]);
        const glm::dvec3 b(mesh.positions[edge[1]]);
        bool allowed = false;
        for (int k = 0; k < 3; ++k) {
            for (const double end : {0.0, static_cast<double>(dims[k] - 1)})
                allowed |= std::abs(a[k] - end) <= tolerance && std::abs(b[k] - end) <= tolerance;
        }
        // The edge lies in a face of a cell with a missing sample, which is one cell away at most.
        const glm::dvec3 middle = 0.5 * (a + b);
        glm::ivec3 i;
        for (i.z = static_cast<int>(std::floor(middle.z)) - 1; i.z <= middle.z + 1 && !allowed; ++i.z) {
            for (i.y = static_cast<int>(std::floor(middle.y)) - 1; i.y <= middle.y + 1; ++i.y) {
                for (i.x = static_cast<int>(std::floor(middle.x)) - 1; i.x <= middle.x + 1; ++i.x) {
                    const glm::ivec3 at = glm::clamp(i, glm::ivec3(0), dims - 1);
                    allowed |= isMissing(at);
                }
            }
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

void expectWatertight(const LevelCase& c, Totals& totals) {
    const Selected selected(c);
    std::vector<MeshPart> parts = meshBricks(selected.fields, selected.bricks, c.options.iso, 1);
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

std::string levelCounts(const Totals& totals) {
    std::string text;
    for (const auto& [level, count] : totals.bricks)
        text += " level " + std::to_string(level) + ": " + std::to_string(count);
    return text;
}

/// How many random views to try: ISOGLASS_VIEWS, else as many as take a few seconds.
std::uint32_t viewCount() {
    const char* count = std::getenv("ISOGLASS_VIEWS");
    return count ? static_cast<std::uint32_t>(std::atoi(count)) : 30;
}

// Sizes that are no multiple of bricks or levels, down to one cell.
constexpr std::array<glm::ivec3, 9> kDims = {{{33, 33, 33},
                                              {61, 57, 64},
                                              {48, 37, 50},
                                              {100, 20, 31},
                                              {70, 70, 2},
                                              {2, 90, 35},
                                              {65, 65, 65},
                                              {130, 9, 12},
                                              {57, 61, 44}}};

TEST(Levels, RandomViewsAreWatertight) {
    Totals totals;
    for (std::uint32_t seed = 0; seed < viewCount() && !HasFailure(); ++seed) {
        const auto kind = static_cast<Kind>(seed % test::kKinds);
        expectWatertight(test::makeLevelCase(seed, kind, kDims[seed % kDims.size()]), totals);
    }
    std::printf("%zu views, %zu triangles, bricks by%s\n", totals.views, totals.triangles,
                levelCounts(totals).c_str());
    for (int level = 0; level <= 2; ++level) EXPECT_GT(totals.bricks[level], 50u) << level;
}

// Each hole of a few samples, or a slab as land under an ocean; in one of the key frames or in both.
TEST(Levels, ViewsOfFieldsWithMissingSamplesAreWatertightBesideThem) {
    Totals totals;
    constexpr std::array kKindsOfWater = {Kind::blobs, Kind::gyroid, Kind::steps};
    for (std::uint32_t seed = 0; seed < viewCount() / 3 && !HasFailure(); ++seed) {
        const glm::ivec3 dims = seed % 2 == 0 ? glm::ivec3(170, 28, 33) : glm::ivec3(40, 120, 41);
        LevelCase c = test::makeLevelCase(seed + 500, kKindsOfWater[seed % kKindsOfWater.size()], dims);
        test::Dice dice(seed);
        for (int hole = 0; hole < 3; ++hole) {
            glm::ivec3 begin;
            glm::ivec3 end;
            for (int k = 0; k < 3; ++k) {
                begin[k] = static_cast<int>(dice.below(dims[k]));
                end[k] = std::min(dims[k], begin[k] + 1 + static_cast<int>(dice.below(hole == 0 ? 12 : 3)));
            }
            const std::uint32_t which = dice.below(3);
            glm::ivec3 i;
            for (i.z = begin.z; i.z < end.z; ++i.z) {
                for (i.y = begin.y; i.y < end.y; ++i.y) {
                    for (i.x = begin.x; i.x < end.x; ++i.x) {
                        const std::size_t place =
                            (static_cast<std::size_t>(i.z) * dims.y + i.y) * dims.x + i.x;
                        if (which != 1) c.samples[0][place] = std::numeric_limits<float>::quiet_NaN();
                        if (which != 0) c.samples[1][place] = std::numeric_limits<float>::quiet_NaN();
                    }
                }
            }
        }
        test::rebuild(c);
        expectWatertight(c, totals);
    }
    std::printf("%zu views, %zu triangles, bricks by%s\n", totals.views, totals.triangles,
                levelCounts(totals).c_str());
    for (int level = 0; level <= 1; ++level) EXPECT_GT(totals.bricks[level], 20u) << level;
}

}  // namespace
}  // namespace isoglass
