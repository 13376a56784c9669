#include "render_fixture.h"
#include "support/ground_truth.h"

#include <glm/ext/matrix_transform.hpp>

namespace isoglass::test {
namespace {

const glm::vec3 kBackground(0.2f, 0.25f, 0.3f);

using Model = ShellOpacity::Model;

const std::vector<ShellOpacity> kShells{
    {.model = Model::slab, .extinction = 10, .thickness = 0.05f},
    {.model = Model::slab, .extinction = 3, .isoWidth = 0.3f, .maxThickness = 0.4f},
    {.model = Model::cosine, .extinction = 10, .thickness = 0.05f},
    {.model = Model::cosine, .extinction = 10, .thickness = 0.05f, .power = 0.607f},
    {.model = Model::isoSpectrum, .extinction = 10, .thickness = 0.05f},
};

class Opacity : public RenderTest {
  protected:
    FrameDescription frame_{
        .camera = {.eye = {0.5, -1, 6}, .up = {0, 1, 0}, .fovDegrees = 30, .size = {40, 40}},
        .background = kBackground,
        .lighting = kUnlit};

    /// 1e-5: the cosine carries about 8 roundings of 2^-24,
    /// 5e-7, and no model's opacity changes faster than 10 times the cosine but beside the rim, which these
    /// quads do not show.
    void expectTruth(const std::vector<TruthSurface>& surfaces) {
        using enum TransparencyMethod;
        for (const TransparencyMethod method : {threePass, fourPass, exact}) {
            frame_.method = method;
            frame_.draws.clear();
            show(frame_, surfaces);
            const LinearImage image = renderLinear(frame_);
            const TruthImage truth = renderTruth(frame_, surfaces, composerOf(frame_));
            EXPECT_EQ(truth.deepest, surfaces.size());
            EXPECT_LT(truth.silhouettePixels(), 20u);
            for (std::size_t i = 0; i < image.pixels.size(); ++i) {
                if (truth.silhouette.pixels[i] == 1) continue;
                ASSERT_LT(largestDifference(image.pixels[i], truth.color.pixels[i]), 1e-5)
                    << "pixel " << i % 40 << "," << i / 40;
            }
        }
    }
};

/// Normals of different directions and lengths at the corners, none seen edge-on.
SurfaceMesh bentQuad(float z) {
    SurfaceMesh mesh = quad(z, 4);
    mesh.normals = {{0.5f, 0.1f, 1}, {-0.6f, 0.9f, 2}, {0.3f, -0.4f, 0.5f}, {0, 0.2f, 1.5f}};
    return mesh;
}

TEST_F(Opacity, OfEveryModelIsThatOfTheFormula) {
    for (const ShellOpacity& shell : kShells) {
        expectTruth({{bentQuad(0), {.color = {0.2f, 0.6f, 0.9f}, .shell = prepareShell(shell)}}});
    }
}

TEST_F(Opacity, ModelsMeetInOneFrame) {
    std::vector<TruthSurface> surfaces{{bentQuad(0), {.color = {0.9f, 0.1f, 0.3f}, .opacity = 0.3f}}};
    for (const ShellOpacity& shell : kShells) {
        const auto z = -0.1f * static_cast<float>(surfaces.size());
        surfaces.push_back({bentQuad(z), {.color = {0.2f, 0.6f, 0.9f}, .shell = prepareShell(shell)}});
    }
    expectTruth(surfaces);
}

/// A placement that stretches: the slab's thickness is measured in the world.
TEST_F(Opacity, OfTheSlabFollowsTheWorldGradient) {
    for (const glm::dvec3 scale : {glm::dvec3(2, 2, 2), glm::dvec3(1, 1.5, 0.25), glm::dvec3(1, 1, -3)}) {
        const glm::dmat4 place = glm::scale(glm::dmat4(1), scale);
        expectTruth({{bentQuad(0),
                      {.worldFromSeries = place,
                       .color = {0.2f, 0.6f, 0.9f},
                       .shell = prepareShell({.extinction = 3, .isoWidth = 0.3f, .maxThickness = 4})}}});
    }
}

/// Where the normal vanishes the slab has its greatest thickness and is seen as if edge-on: opaque.
TEST_F(Opacity, OfANullNormalIsANumber) {
    for (const ShellOpacity& shell : kShells) {
        TruthSurface surface{quad(0, 4), {.color = {0.5f, 0.5f, 0.5f}, .shell = prepareShell(shell)}};
        surface.mesh.normals.assign(4, glm::vec3(0));
        frame_.draws.clear();
        show(frame_, {surface});
        for (const glm::vec3& pixel : renderLinear(frame_).pixels) {
            ASSERT_TRUE(pixel.x >= 0 && pixel.x <= 1) << pixel.x;
        }
    }
}

/// Seen from all sides, the silhouette of a ball included: shares of light, never more.
TEST_F(Opacity, OfABallStaysAShareAtTheRim) {
    for (const ShellOpacity& shell : kShells) {
        frame_.draws.clear();
        show(frame_, {{sphere({0, 0, 0}, 1, 24), {.color = {1, 1, 1}, .shell = prepareShell(shell)}}});
        for (const glm::vec3& pixel : renderLinear(frame_).pixels) {
            // Two crossings, each of which emits at most 1.
            ASSERT_TRUE(pixel.x >= 0 && pixel.x <= 2) << pixel.x;
        }
    }
}

}  // namespace
}  // namespace isoglass::test
