// The light of cuts: the four demands of D. Weiskopf, K. Engel and T. Ertl, "Interactive Clipping Techniques
// for Texture-Based Volume Visualization and Volume Shading", 2003, section 5.2.

#include "clip_reference.h"
#include "layer_fixture.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

namespace isoglass::test {
namespace {

using Weight = CutLight::Weight;

constexpr float kAmbient = 0.25f, kDiffuse = 0.5f;

double weightAt(const CutLight& cut, double distance) {
    const double part = distance / cut.thickness;
    if (part >= 1) return 0;
    if (cut.weight == Weight::step) return 1;
    return cut.weight == Weight::ramp ? 1 - part : 1 - part * part * (3 - 2 * part);
}

/// World distance of a point from a solid's surface, above 0 outside, for a place that turns and scales
/// evenly.
double signedDistance(const SolidClip& solid, const glm::dvec3& at) {
    const glm::dvec3 p(glm::inverse(solid.seriesFromSolid) * glm::dvec4(at, 1));
    const double scale = glm::length(glm::dvec3(solid.seriesFromSolid[0]));
    if (solid.shape == SolidShape::sphere) return scale * (glm::length(p) - 1);
    glm::dvec3 over = glm::abs(p) - 1.0;
    if (solid.shape == SolidShape::cylinder) over = {glm::length(glm::dvec2(p)) - 1, over.z, -kInfinity};
    const double most = std::max({over.x, over.y, over.z});
    return scale * (most <= 0 ? most : glm::length(glm::max(over, 0.0)));
}

/// Along the distance; of length 1 but where two surfaces are equally near.
glm::dvec3 distanceGradient(const SolidClip& solid, const glm::dvec3& at) {
    constexpr double kHalf = 1e-5;
    glm::dvec3 gradient;
    for (int k = 0; k < 3; ++k) {
        glm::dvec3 reach(0);
        reach[k] = kHalf;
        gradient[k] = (signedDistance(solid, at + reach) - signedDistance(solid, at - reach)) / (2 * kHalf);
    }
    return gradient;
}

/// A white medium that is lit by the gradient.
class CutLightTest : public VolumeTest {
  protected:
    void SetUp() override {
        VolumeTest::SetUp();
        frame_.shadedDraw.emplace();
        style() = {.colors = {{0, {1, 1, 1}}}, .opacities = {{0, 1}}, .unit = 0.5};
        frame_.lighting = {.ambient = kAmbient, .diffuse = kDiffuse, .specular = 0, .shininess = 1};
        setLattice({17, 17, 17});
    }

    VolumeDraw& volume() override { return *frame_.shadedDraw; }
    VolumeStyle& style() { return frame_.shadedDraw->style; }

    double meanDifference(const LinearImage& a, const LinearImage& b) const {
        double sum = 0;
        for (std::size_t i = 0; i < a.pixels.size(); ++i)
            sum += largestDifference(a.pixels[i], glm::dvec3(b.pixels[i]));
        return sum / static_cast<double>(a.pixels.size());
    }
};

/// Across the gradient the medium has its ambient light alone: what comes to it is the cut's. An opaque step
/// of 1/16 is seen at its middle.
TEST_F(CutLightTest, TheOrientationOfAPlaneIsLit) {
    upload(sampled([](const glm::dvec3& p) { return p.x; }));
    frame_.camera = {.eye = {0, 1e3, 0}, .fovDegrees = 0.01, .size = {4, 4}};
    // Places seen from 1000 away are off by 2^-14, and so by as much of a thickness of 1/2.
    constexpr double kFarAway = 4 * 0x1p-14;
    for (const Weight weight : {Weight::step, Weight::ramp, Weight::smooth}) {
        style().cut = CutLight{.thickness = 0.5, .weight = weight};
        for (const double degrees : {0.0, 30.0, 60.0, 80.0}) {
            const double cosine = std::cos(degrees * M_PI / 180), sine = std::sin(degrees * M_PI / 180);
            // Twice as long: the normal's length means nothing.
            volume().planes = {{0, -2 * cosine, -2 * sine, 0}};
            const double share = weightAt(*style().cut, cosine / 32);
            for (const glm::vec3& pixel : renderLinear(frame_).pixels)
                EXPECT_NEAR(pixel.x, kAmbient + share * kDiffuse * cosine, kFarAway) << degrees;
        }
    }
}

/// Of every shape, kept and cut away, in every pixel that sees a cut from outside: normal and distance by
/// differences of the exact distance at the middle of the first step. A flat medium is lit in full.
TEST_F(CutLightTest, TheOrientationOfSolidsIsLit) {
    upload(sampled([](const glm::dvec3&) { return 1; }));
    style().cut = CutLight{.thickness = 0.1, .weight = Weight::ramp};
    for (const SolidShape shape : {SolidShape::box, SolidShape::sphere, SolidShape::cylinder}) {
        for (const Keep keep : {Keep::inside, Keep::outside}) {
            const glm::dvec3 at = keep == Keep::inside ? glm::dvec3(0.1, 0, -0.1) : glm::dvec3(0.9, 0.6, 0.7);
            const SolidClip solid{shape, keep, placed(at, glm::dvec3(0.6), 40)};
            volume().solids = {solid};
            const LinearImage image = renderLinear(frame_);
            int certain = 0;
            forEachPixel([&](int x, int y, std::size_t i) {
                const Ray ray = pixelRay(frame_.camera, x + 0.5, y + 0.5);
                const std::vector<Interval> parts = visibleParts(volume().solids, ray);
                if (parts.empty()) return;
                const double step = 0.5 / glm::length(ray.direction * 8.0);
                if (parts[0].end - parts[0].begin < step) return;
                const glm::dvec3 middle = ray.origin + (parts[0].begin + step / 2) * ray.direction;
                const glm::dvec3 normal = distanceGradient(solid, middle);
                if (std::abs(glm::length(normal) - 1) > 1e-6) return;
                const double share = weightAt(*style().cut, std::abs(signedDistance(solid, middle)));
                const double cosine = std::abs(glm::dot(normal, glm::normalize(ray.direction)));
                // Places are off by 2^-20, distances by that of the thickness of 1/10.
                EXPECT_NEAR(image.pixels[i].x, kAmbient + kDiffuse * (1 + share * (cosine - 1)), 1e-4)
                    << x << ", " << y;
                certain += share > 0;
            });
            EXPECT_GT(certain, 100) << static_cast<int>(shape);
        }
    }
}

/// Where light does not depend on directions, a lit cut shows what the volume shows.
TEST_F(CutLightTest, MaterialMatchesTheVolumeAtTheCut) {
    upload(makeVolumeSamples(dims(), randomFloats(dims(), 4)));
    style().colors = {{0.2, {1, 0, 0}}, {0.8, {0, 0, 1}}};
    style().opacities = {{0.2, 0}, {0.8, 0.8f}};
    frame_.lighting = {.ambient = 1, .diffuse = 0, .specular = 0, .shininess = 1};
    volume().solids = {{SolidShape::sphere, Keep::outside, placed({0.6, 0.5, 0.6}, glm::dvec3(0.7))}};
    const LinearImage right = renderLinear(frame_);
    style().cut = CutLight{.thickness = 0.5, .weight = Weight::step};
    EXPECT_EQ(meanDifference(renderLinear(frame_), right), 0);
}

/// Bit by bit, on rays that stay away from the cut by more than the thickness; others change.
TEST_F(CutLightTest, LightAwayFromTheCutIsUnchanged) {
    upload(makeVolumeSamples(dims(), randomFloats(dims(), 5)));
    style().opacities = {{0.2, 0}, {0.8, 0.8f}};
    const glm::dvec3 middle(0.3, 0.2, 0.4);
    constexpr double kRadius = 0.5, kThickness = 0.2;
    volume().solids = {{SolidShape::sphere, Keep::outside, placed(middle, glm::dvec3(kRadius))}};
    const LinearImage right = renderLinear(frame_);
    style().cut = CutLight{.thickness = kThickness, .weight = Weight::step};
    const LinearImage lit = renderLinear(frame_);
    int away = 0, changed = 0;
    forEachPixel([&](int x, int y, std::size_t i) {
        const Ray ray = pixelRay(frame_.camera, x + 0.5, y + 0.5);
        const double distance = glm::length(glm::cross(middle - ray.origin, glm::normalize(ray.direction)));
        changed += lit.pixels[i] != right.pixels[i];
        if (distance < kRadius + kThickness + 1e-5) return;
        EXPECT_EQ(lit.pixels[i], right.pixels[i]) << x << ", " << y;
        ++away;
    });
    EXPECT_GT(away, 100);
    EXPECT_GT(changed, 100);
}

/// With the step the picture converges, and not to one without the cut's light, as a skin without thickness
/// would.
TEST_F(CutLightTest, ConvergesAsTheStepGoesToZero) {
    upload(sampled([](const glm::dvec3& p) { return glm::dot(p, {0.5, 0.3, 0.2}); }));
    style().colors = {{-1, {1, 0.5, 0}}, {1, {0, 0.5, 1}}};
    style().opacities = {{-1, 0.3f}, {1, 0.7f}};
    volume().solids = {{SolidShape::sphere, Keep::outside, placed({0.7, 0.5, 0.6}, glm::dvec3(0.7))},
                       {SolidShape::cylinder, Keep::inside, placed({0, 0, 0}, glm::dvec3(0.9), 30)}};
    volume().planes = {{0, 0, -1, 0.6}};
    for (const Weight weight : {Weight::step, Weight::ramp, Weight::smooth}) {
        const auto picture = [&](double step, bool lit) {
            style().step = step;
            style().cut.reset();
            if (lit) style().cut = CutLight{.thickness = 0.25, .weight = weight};
            return renderLinear(frame_);
        };
        double before = kInfinity;
        LinearImage coarse = picture(2, true);
        for (const double step : {1.0, 0.5, 0.25, 0.125}) {
            const LinearImage fine = picture(step, true);
            const double change = meanDifference(fine, coarse);
            // A step function is off by up to one step where it ends: the first order halves it on average.
            EXPECT_LT(change, 0.75 * before) << step;
            before = change;
            coarse = fine;
        }
        EXPECT_GT(meanDifference(picture(0.125, false), coarse), 10 * before);
    }
}

}  // namespace
}  // namespace isoglass::test
