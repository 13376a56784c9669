#include "render_fixture.h"
#include "support/ground_truth.h"

#include <glm/ext/matrix_transform.hpp>

namespace isoglass::test {
namespace {

/// Volumes of two surfaces each, an outer semi-transparent one and an inner one.
std::vector<TruthSurface> volumeAt(const glm::dmat4& place, const glm::vec3& color, float innerOpacity) {
    return {{sphere({0, 0, 0}, 0.8f, 16), {.worldFromSeries = place, .color = color, .opacity = 0.35f}},
            {sphere({0.1f, 0, 0}, 0.4f, 16),
             {.worldFromSeries = place, .color = glm::vec3(1) - color, .opacity = innerOpacity}}};
}

std::vector<TruthSurface> both(std::vector<TruthSurface> first, const std::vector<TruthSurface>& second) {
    first.insert(first.end(), second.begin(), second.end());
    return first;
}

class OverlappingVolumes : public RenderTest, public testing::WithParamInterface<TransparencyMethod> {
  protected:
    FrameDescription frame_{.camera = {.eye = {3, 2, 2.5}, .fovDegrees = 34, .size = {64, 48}},
                            .background = {0.2f, 0.25f, 0.3f},
                            .lighting = {},
                            .method = GetParam()};

    /// 1e-3 in linear colour away from silhouettes, as the engine promises; found are some 1e-6.
    void expectTruth(const std::vector<TruthSurface>& surfaces) {
        show(frame_, surfaces);
        const LinearImage image = renderLinear(frame_);
        const TruthImage truth = renderTruth(frame_, surfaces, composerOf(frame_));
        EXPECT_EQ(truth.deepest, 8u) << "two crossings of each of the four surfaces";
        EXPECT_LT(truth.silhouettePixels(), image.pixels.size() / 10);
        for (std::size_t i = 0; i < image.pixels.size(); ++i) {
            if (truth.silhouette.pixels[i] == 1) continue;
            ASSERT_LT(largestDifference(image.pixels[i], truth.color.pixels[i]), 1e-3)
                << "pixel " << i % 64 << "," << i / 64;
        }
    }
};

TEST_P(OverlappingVolumes, ThatIntersect) {
    glm::dmat4 second = glm::translate(glm::dmat4(1), glm::dvec3(0.6, 0.3, -0.2));
    second = glm::scale(glm::rotate(second, 0.7, glm::dvec3(1, 2, 3)), glm::dvec3(1.3, 0.7, 1));
    expectTruth(
        both(volumeAt(glm::dmat4(1), {0.9f, 0.2f, 0.1f}, 0.5f), volumeAt(second, {0.1f, 0.3f, 0.9f}, 1)));
}

/// Every fragment twice at the same depth: none may be lost. They have the same colours, because which one
/// comes first at one depth is the engine's choice; in one colour the order does not matter.
TEST_P(OverlappingVolumes, ThatCoincide) {
    const glm::dmat4 place = glm::rotate(glm::dmat4(1), 0.4, glm::dvec3(3, 2, 1));
    expectTruth(both(volumeAt(place, {0.9f, 0.2f, 0.1f}, 0.5f), volumeAt(place, {0.9f, 0.2f, 0.1f}, 0.6f)));
}

TEST_P(OverlappingVolumes, ThatNest) {
    const glm::dmat4 inside =
        glm::scale(glm::translate(glm::dmat4(1), glm::dvec3(0.15, 0.05, 0)), glm::dvec3(0.3));
    expectTruth(
        both(volumeAt(glm::dmat4(1), {0.9f, 0.2f, 0.1f}, 0.5f), volumeAt(inside, {0.1f, 0.3f, 0.9f}, 1)));
}

INSTANTIATE_TEST_SUITE_P(Methods, OverlappingVolumes,
                         testing::Values(TransparencyMethod::threePass, TransparencyMethod::fourPass,
                                         TransparencyMethod::exact),
                         [](const auto& method) {
                             if (method.param == TransparencyMethod::exact) return "exact";
                             return method.param == TransparencyMethod::threePass ? "threePass" : "fourPass";
                         });

}  // namespace
}  // namespace isoglass::test
