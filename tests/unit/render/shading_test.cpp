#include "render_fixture.h"

#include <glm/ext/matrix_transform.hpp>

namespace isoglass::test {
namespace {

constexpr Lighting kLit{.ambient = 0.15f, .diffuse = 0.7f, .specular = 0.4f, .shininess = 20};

class Shading : public RenderTest {
  protected:
    FrameDescription frame_{
        .camera = {.eye = {0.5, -1, 6}, .up = {0, 1, 0}, .fovDegrees = 30, .size = {40, 40}},
        .lighting = kLit};

    /// 1e-4: directions are float (2^-22 after a few operations) and the specular power multiplies their
    /// relative error by its exponent of 20, twice with weight 0.4.
    void expectFormula(const TruthSurface& surface) {
        frame_.draws.clear();
        show(frame_, {surface});
        const TruthImage truth = renderTruth(frame_, {surface}, composerOf(frame_));
        const LinearImage image = renderLinear(frame_);
        // The quad fills the picture; its diagonal is no silhouette.
        EXPECT_EQ(truth.silhouettePixels(), 0u);
        EXPECT_EQ(truth.deepest, 1u);
        EXPECT_EQ(differenceBeyond({.threshold = 1e-4, .mean = 1e-4, .largest = 1e-4}, "shading", image,
                                   truth.color),
                  "");
    }
};

/// Normals of different directions and lengths at the corners.
SurfaceMesh bentQuad(float normalScale) {
    SurfaceMesh mesh = quad(0, 4);
    mesh.normals = {{0.5f, 0.1f, 1}, {-0.6f, 0.9f, 2}, {0.3f, -0.4f, 0.5f}, {0, 0.2f, 1.5f}};
    for (glm::vec3& normal : mesh.normals) normal *= normalScale;
    return mesh;
}

TEST_F(Shading, NormalisesTheInterpolatedNormalPerFragment) {
    expectFormula({bentQuad(1), {.color = {0.2f, 0.6f, 0.9f}}});
}

TEST_F(Shading, TakesGradientsOfAnyLength) {
    expectFormula({bentQuad(1e-22f), {.color = {0.2f, 0.6f, 0.9f}}});
    expectFormula({bentQuad(1e22f), {.color = {0.2f, 0.6f, 0.9f}}});
}

TEST_F(Shading, LightsBothSidesAlike) {
    SurfaceMesh turned = bentQuad(-1);
    std::swap(turned.triangles[1], turned.triangles[2]);
    std::swap(turned.triangles[4], turned.triangles[5]);
    expectFormula({turned, {.color = {0.2f, 0.6f, 0.9f}}});
    frame_.draws.clear();
    show(frame_, {{bentQuad(1), {}}});
    const LinearImage front = renderLinear(frame_);
    frame_.draws.clear();
    show(frame_, {{turned, {}}});
    const LinearImage back = renderLinear(frame_);
    for (std::size_t i = 0; i < front.pixels.size(); ++i) {
        // Turning the winding turns the interpolation's rounding, nothing else.
        ASSERT_LT(largestDifference(front.pixels[i], back.pixels[i]), 1e-5);
    }
}

TEST_F(Shading, TransformsNormalsByTheInverseTranspose) {
    glm::dmat4 place = glm::rotate(glm::dmat4(1), 0.3, glm::dvec3(1, 0.5, 0.2));
    place = glm::scale(place, glm::dvec3(1, 2, -0.25));
    expectFormula({bentQuad(1), {.worldFromSeries = place, .color = {0.2f, 0.6f, 0.9f}}});
}

TEST_F(Shading, ANullNormalIsDarkButANumber) {
    TruthSurface surface{quad(0, 4), {.color = {0.5f, 0.5f, 0.5f}, .opacity = 0.5f}};
    surface.mesh.normals.assign(4, glm::vec3(0));
    show(frame_, {surface});
    const LinearImage image = renderLinear(frame_);
    EXPECT_LT(largestDifference(image.at(20, 20), glm::dvec3(0.5 * 0.5 * kLit.ambient)), 1e-6);
}

}  // namespace
}  // namespace isoglass::test
