// What a view does not see is left out of a mesh, and nothing else changes.

#include "unit/levels/level_case.h"
#include "unit/levels/triangle_set.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <vector>

namespace isoglass {
namespace {

using test::Corners;

bool isHidden(const Corners& triangle, const glm::dvec3& origin, const std::vector<glm::dvec4>& planes) {
    return std::ranges::any_of(planes, [&](const glm::dvec4& plane) {
        return std::ranges::all_of(triangle, [&](const std::array<float, 3>& vertex) {
            const glm::dvec3 position = origin + glm::dvec3(vertex[0], vertex[1], vertex[2]);
            return glm::dot(plane, glm::dvec4(position, 1)) < 0;
        });
    });
}

/// A wedge with its edge at the eye, turned at random, and the plane through the eye.
std::vector<glm::dvec4> randomPlanes(test::Dice& dice, glm::dvec3 eye, glm::dvec3 target) {
    const glm::dvec3 forward = glm::normalize(target - eye);
    const glm::dvec3 any(dice.between(-1, 1), dice.between(-1, 1), dice.between(-1, 1));
    const glm::dvec3 side = glm::normalize(glm::cross(forward, any));
    std::vector<glm::dvec4> planes;
    for (const glm::dvec3 normal : {forward * 0.2 - side, forward * 0.2 + side, forward})
        planes.emplace_back(normal, -glm::dot(normal, eye));
    return planes;
}

void expectOnlyUnseenIsMissing(test::LevelCase c, std::size_t& leftOut) {
    SCOPED_TRACE(c.name);
    const Extraction whole = extractSurface(c.lattice, c.field, c.options);
    test::Dice dice(static_cast<std::uint32_t>(whole.mesh.triangleCount()));
    View& view = *c.options.view;
    view.planes = randomPlanes(dice, view.eye, 0.5 * glm::dvec3(c.lattice.cells()));
    const Extraction seen = extractSurface(c.lattice, c.field, c.options);
    EXPECT_FALSE(whole.stats.leftOut);
    const auto all = test::trianglesOf(whole.mesh);
    const auto some = test::trianglesOf(seen.mesh);
    EXPECT_TRUE(std::ranges::includes(all, some));
    std::vector<Corners> missing;
    std::ranges::set_difference(all, some, std::back_inserter(missing));
    for (const Corners& triangle : missing) EXPECT_TRUE(isHidden(triangle, whole.mesh.origin, view.planes));
    EXPECT_TRUE(missing.empty() || seen.stats.leftOut);
    leftOut += missing.size();
    c.options.threads = 3;
    const Extraction again = extractSurface(c.lattice, c.field, c.options);
    EXPECT_EQ(seen.mesh.positions, again.mesh.positions);
    EXPECT_EQ(seen.mesh.triangles, again.mesh.triangles);
}

TEST(SeenBricks, MeshesLackOnlyWhatLiesBehindOnePlane) {
    std::size_t leftOut = 0;
    for (std::uint32_t seed = 0; seed < 20; ++seed) {
        test::LevelCase c =
            test::makeLevelCase(seed, static_cast<test::Kind>(seed % test::kKinds),
                                seed % 2 == 0 ? glm::ivec3(61, 57, 64) : glm::ivec3(33, 90, 35));
        // An eye in and beside the lattice, so that some is seen and some is not.
        for (int k = 0; k < 3; ++k) c.options.view->eye[k] *= 0.2;
        if (seed % 3 == 0) c.options.view->cellPixels = 0;
        expectOnlyUnseenIsMissing(c, leftOut);
    }
    EXPECT_GT(leftOut, 10'000u);
}

TEST(SeenBricks, ClippedAndClosedMeshesAreWhole) {
    test::LevelCase c = test::makeLevelCase(1, test::Kind::blobs, glm::ivec3(41));
    c.options.view->planes = {{1, 0, 0, -1000}};
    EXPECT_TRUE(extractSurface(c.lattice, c.field, c.options).mesh.empty());
    c.options.closed = true;
    const std::size_t closed = extractSurface(c.lattice, c.field, c.options).mesh.triangleCount();
    c.options.view.reset();
    EXPECT_GT(closed, 0u);
    EXPECT_EQ(closed, extractSurface(c.lattice, c.field, c.options).mesh.triangleCount());
}

}  // namespace
}  // namespace isoglass
