#include "surface/level_values.h"

#include "unit/levels/level_case.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace isoglass {
namespace {

using test::LevelCase;

// By the distance metric the size of a cell is cellPixels * distance / pixelsPerUnit; level l is alone up to
// 1.9 times its cells, and has given way to the next one at twice.
TEST(LevelAtVertices, IsWhatTheDistanceSays) {
    LevelCase c = test::makeLevelCase(4, test::Kind::blobs, glm::ivec3(65));
    View& view = *c.options.view;
    view.cellPixels = view.pixelsPerUnit / 15;
    view.eye = {-12, 30, 33};
    const Extraction extraction = extractSurface(c.lattice, c.field, c.options);
    const std::vector<float> levels = levelAtVertices(extraction.mesh, c.lattice, c.field, c.options);
    ASSERT_EQ(levels.size(), extraction.mesh.vertexCount());
    float lowest = 10;
    float highest = 0;
    for (std::size_t i = 0; i < levels.size(); ++i) {
        const glm::dvec3 position = extraction.mesh.origin + glm::dvec3(extraction.mesh.positions[i]);
        // The size at the nearest sample; half a cell diagonal away it differs by at most sqrt(3) / 2 / 15.
        const auto levelOf = [](double size) {
            const double level = std::floor(std::log2(std::max(1.0, size)));
            return level + std::clamp((size / std::exp2(level) - 1.9) / 0.1, 0.0, 1.0);
        };
        const double size = glm::length(position - view.eye) / 15;
        constexpr double kSlack = 0.0578;
        // A size below 8 carries four roundings of 2^-22 at most, and blending multiplies by 10.
        constexpr double kRounding = 40 * 0x1p-22;
        EXPECT_GE(levels[i], levelOf(size - kSlack) - kRounding);
        EXPECT_LE(levels[i], levelOf(size + kSlack) + kRounding);
        lowest = std::min(lowest, levels[i]);
        highest = std::max(highest, levels[i]);
    }
    EXPECT_LT(lowest, 1.0f);
    EXPECT_GE(highest, 2.0f);
}

TEST(LevelAtVertices, IsZeroAtFullResolution) {
    LevelCase c = test::makeLevelCase(4, test::Kind::blobs, glm::ivec3(33));
    c.options.closed = true;
    const Extraction extraction = extractSurface(c.lattice, c.field, c.options);
    const std::vector<float> levels = levelAtVertices(extraction.mesh, c.lattice, c.field, c.options);
    EXPECT_EQ(levels, std::vector<float>(extraction.mesh.vertexCount()));
}

}  // namespace
}  // namespace isoglass
