// The style "illustrative": what is drawn from normals and distances against the paper's equations, and
// closed forms of single effects. Equation numbers are those of J. Fischer, D. Bartz and W. Strasser,
// "Illustrative Display of Hidden Iso-Surface Structures", 2005.

#include "illustration_fixture.h"

#include <glm/ext/matrix_transform.hpp>

#include <map>
#include <optional>

namespace isoglass::test {
namespace {

class Drawing : public IllustrationTest {
  protected:
    /// Below that single precision may decide another way: sums of a few products of numbers up to 4, and for
    /// distances differences of numbers up to 1 / (pixel size) times as large.
    double uncertainty() const { return 32 * 0x1p-23 / pixelSize(); }

    /// The whole picture from what the geometry passes left; returns the pixels of each colour.
    std::map<std::string, int> expectEquations() {
        frame_.samples = 1;
        const LinearImage picture = renderLinear(frame_);
        const Geometry first = unpacked(renderer_.readIntegers(Target::firstSurface));
        const Geometry second = unpacked(renderer_.readIntegers(Target::secondSurface));
        const bool secondary = renderer_.plan().runs(PassKind::secondaryGeometry);
        const Geometry shade = secondary ? renderer_.readFloats(Target::secondaryShade) : Geometry{};
        const IllustrationReference reference(style(), pixelSize());
        std::map<std::string, int> seen;
        forEachPixel([&](int x, int y) {
            const Decision front = reference.silhouette(first, x, y);
            const Decision back = reference.silhouette(second, x, y);
            const double lit = IllustrationReference::intensity(glm::dvec3(first.at(x, y)), light());
            Decision hatch = reference.hatched(lit, x + 0.5, first.size.y - y - 0.5);
            if (first.at(x, y).w == 0) hatch = {false};
            if (std::min({front.margin, back.margin, hatch.margin}) < uncertainty()) return;
            ++seen["certain"];
            // Section 3.3.4, in that order.
            glm::dvec3 color(back.yes ? kBack : kPaper);
            if (secondary) {
                const glm::dvec4 s(shade.at(x, y));
                const double intensity = back.yes && s.a <= 0 ? 0 : std::abs(s.a);  // (10)
                color = glm::mix(color, glm::dvec3(s), intensity);
            }
            const bool isFront = front.yes || hatch.yes;
            if (isFront) color = kFront;
            seen[front.yes ? "front line" : hatch.yes ? "hatched" : back.yes ? "back line" : "rest"]++;
            EXPECT_LE(largestDifference(picture.at(x, y), color), 0x1p-20) << x << ", " << y;
        });
        return seen;
    }
};

TEST_F(Drawing, FollowsTheEquationsPixelByPixel) {
    frame_.camera = {.eye = {3, -4, 2.5}, .fovDegrees = 30, .size = {160, 120}};
    add(sphere({0, 0, 0}, 1, 16));
    add(sphere({0.2f, 0.1f, 0}, 0.6f, 12));
    add(quad(0.3f, 1.4f));
    auto seen = expectEquations();
    EXPECT_GT(seen["certain"], 160 * 120 * 98 / 100);
    for (const char* const kind : {"front line", "hatched", "back line", "rest"})
        EXPECT_GT(seen[kind], 100) << kind;
    addSecondary(sphere({-0.3f, 0, 0.5f}, 0.5f, 12));
    style().hatchAngle = -35;
    style().hatchSize = 6.5f;
    style().hatchCross = 0.4f;
    style().depthThreshold = 2;
    style().normalThreshold = 3.7f;
    seen = expectEquations();
    EXPECT_GT(seen["certain"], 160 * 120 * 98 / 100);
    for (const char* const kind : {"front line", "hatched", "back line", "rest"})
        EXPECT_GT(seen[kind], 100) << kind;
}

/// Equation 2: in front of all, behind one surface and behind two; paper shows as far as brightness lacks.
TEST_F(Drawing, SecondaryGeometryGetsDarkerBehindEachSurface) {
    style().light = {0, 0, 1};
    style().depthThreshold = 1e6f;
    const auto brightness = [&](float z) {
        frame_.draws.resize(2);
        addSecondary(quad(z, 5));
        return renderLinear(frame_).at(30, 24);
    };
    add(quad(1, 5));
    add(quad(-1, 5));
    const auto mixed = [](double share) {
        return glm::mix(glm::dvec3(kPaper), glm::dvec3(kSecondary), share);
    };
    EXPECT_LE(largestDifference(brightness(2), mixed(1)), 1e-6);
    EXPECT_LE(largestDifference(brightness(0), mixed(0.7)), 1e-6);
    EXPECT_LE(largestDifference(brightness(-2), mixed(0.21)), 1e-6);
    // At the surface itself it counts as behind (2).
    EXPECT_LE(largestDifference(brightness(1), mixed(0.7)), 1e-6);
    EXPECT_LE(largestDifference(brightness(-1), mixed(0.21)), 1e-6);
}

/// Equation 1: with the light 60 degrees off, half as bright.
TEST_F(Drawing, SecondaryGeometryIsLitDiffusely) {
    style().light = {std::sqrt(3.0f), 0, 1};
    addSecondary(quad(0, 5));
    const glm::dvec3 half = 0.5 * (glm::dvec3(kPaper) + glm::dvec3(kSecondary));
    for (const glm::vec3& pixel : renderLinear(frame_).pixels)
        EXPECT_LE(largestDifference(pixel, half), 1e-6);
    EXPECT_FALSE(renderer_.plan().runs(PassKind::firstSurface));
}

/// Equation 10: a silhouette of the second surface covers what is behind that, and not what is in front.
TEST_F(Drawing, SecondSilhouettesCoverSecondaryGeometryBehindThem) {
    style().light = {0, 0, 1};
    add(quad(1, 5));
    add(quad(-1, 0.5f));  // its rim is the only line, half of it beside the surface
    const LinearImage alone = renderLinear(frame_);
    const Geometry second = unpacked(renderer_.readIntegers(Target::secondSurface));
    int onSurface = 0;
    for (std::size_t i = 0; i < alone.pixels.size(); ++i)
        onSurface += alone.pixels[i] == kBack && second.pixels[i].w > 0;
    EXPECT_GT(onSurface, 40);
    EXPECT_GT(count(alone, kBack), onSurface + 40);
    addSecondary(quad(-2, 5));
    EXPECT_EQ(count(renderLinear(frame_), kBack), onSurface);
    frame_.draws.pop_back();
    addSecondary(quad(0, 5));
    EXPECT_EQ(count(renderLinear(frame_), kBack), 0);
}

/// A plane whose distance changes by `tangent` pixel sizes a pixel in the middle of the picture. The light
/// falls straight on it, so nothing is hatched.
TEST_F(Drawing, ASlopeIsALineFromTheThresholdOn) {
    frame_.camera = fromAbove(100, {33, 33});
    frame_.camera.fovDegrees = 1;
    style().depthThreshold = 2;
    const auto isLine = [&](double tangent) {
        frame_.draws.clear();
        style().light = {tangent, 0, 1};
        add(quad(0, 50), {.worldFromSeries = glm::rotate(glm::dmat4(1), std::atan(tangent), {0, 1, 0})});
        return renderLinear(frame_).at(16, 16) == kFront;
    };
    EXPECT_FALSE(isLine(1.99));
    EXPECT_TRUE(isLine(2.01));
}

/// The integral of (9) over a period: of light I up to c the share 1 - I is black (c - I of strokes along s,
/// 1 - c of those across), above c, as long as (I - c) / (1 - c) < c, the share 1 - c.
TEST_F(Drawing, HatchingIsAsDarkAsTheLightIsWeak) {
    frame_.camera.size = {400, 400};
    style().hatchSize = 8;
    add(quad(0, 5));
    for (const auto& [light, share] : {std::pair(0.2, 0.8), {0.5, 0.5}, {0.8, 0.2}, {0.95, 0.1}}) {
        style().light = glm::vec3(std::sqrt(1 - light * light), 0, light);
        const double black = count(renderLinear(frame_), kFront) / 160000.0;
        // Four rims of strokes cross a period of 8 by 8, so half of all pixels have one in them. If those
        // fell at random, their share would be off by 0.001 (one standard deviation).
        EXPECT_NEAR(black, share, 0.005) << light;
    }
}

TEST_F(Drawing, NothingIsHatchedWhereThereIsNoSurface) {
    style().light = {0, 0, -1};
    add(quad(0, 0.3f));
    const LinearImage image = renderLinear(frame_);
    EXPECT_EQ(image.at(2, 2), kPaper);
    // The light comes from behind: all of it is dark, also where the pattern is lightest.
    const Geometry first = unpacked(renderer_.readIntegers(Target::firstSurface));
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        if (first.pixels[i].w > 0) {
            EXPECT_EQ(image.pixels[i], kFront);
        }
    }
    frame_.draws.clear();
    for (const glm::vec3& pixel : renderLinear(frame_).pixels) EXPECT_EQ(pixel, kPaper);
}

/// The paper has no surfaces that end: the side that is seen is lit, whichever it is.
TEST_F(Drawing, BothSidesOfAnOpenSurfaceAreLit) {
    add(quad(0, 0.7f));
    const LinearImage above = renderLinear(frame_);
    frame_.draws.clear();
    add(quad(0, 0.7f, true));
    EXPECT_EQ(renderLinear(frame_).pixels, above.pixels);
}

TEST_F(Drawing, PaperIsAsTransparentAsTheBackground) {
    frame_.backgroundOpacity = 0;
    style().light = {0, 0, 1};
    add(quad(0, 0.5f));
    renderer_.render(frame_);
    const Image image = renderer_.readSrgb();
    EXPECT_EQ(image.at(2, 2).a, 0);
    EXPECT_EQ(image.at(30, 24).a, 0);
    EXPECT_EQ(std::ranges::count(image.pixels, 255, &Rgba8::a), count(renderer_.readLinear(), kFront));
}

/// Lines stay a pixel of the picture wide, hatching keeps its size: a sample's neighbours are a pixel away.
TEST_F(Drawing, MoreSamplesConvergeToOnePicture) {
    frame_.camera = {.eye = {3, -4, 2.5}, .fovDegrees = 30, .size = {96, 80}};
    add(sphere({0, 0, 0}, 1, 24));
    add(sphere({0.2f, 0.1f, 0}, 0.6f, 24));
    frame_.samples = 64;
    const LinearImage right = renderLinear(frame_);
    const auto off = [&](int samples) {
        frame_.samples = samples;
        const LinearImage image = renderLinear(frame_);
        double sum = 0;
        for (std::size_t i = 0; i < image.pixels.size(); ++i)
            sum += largestDifference(image.pixels[i], glm::dvec3(right.pixels[i]));
        return sum;
    };
    // The error of an edge's coverage shrinks at least with the root of the number of samples.
    const double one = off(1), four = off(4), sixteen = off(16);
    EXPECT_LT(four, one / 2);
    EXPECT_LT(sixteen, four / 2);
}

/// Flicker would change pixels to and fro, the more often the finer the steps; what the motion explains
/// changes them the same number of times however many steps it is cut into.
TEST_F(Drawing, IsSteadyInMotion) {
    add(sphere({0.7f, 0, 0}, 0.6f, 32));
    add(sphere({-0.5f, 0.5f, 0.2f}, 0.5f, 24));
    add(quad(-0.3f, 1.2f));
    const auto changes = [&](int steps) {
        int changed = 0;
        std::optional<LinearImage> before;
        for (int i = 0; i <= steps; ++i) {
            const double angle = 0.1 * i / steps;
            frame_.camera = {
                .eye = {5 * std::sin(angle), -5 * std::cos(angle), 2}, .fovDegrees = 28, .size = {96, 80}};
            LinearImage image = renderLinear(frame_);
            for (std::size_t p = 0; before && p < image.pixels.size(); ++p)
                changed += image.pixels[p] != before->pixels[p];
            before = std::move(image);
        }
        return changed;
    };
    const int coarse = changes(64), fine = changes(128);
    EXPECT_GT(coarse, 500);
    // 1 without flicker, 2 with nothing but flicker.
    EXPECT_LT(fine, 1.25 * coarse);
}

/// Only the part of the picture with surfaces is worked on: two small ones at the ends of the picture look
/// the same alone as together, with their lines around them and paper beyond; so does one that reaches behind
/// the eye.
TEST_F(Drawing, WhatIsAroundTheSurfacesIsPaper) {
    const auto at = [](double x, double y) {
        return SurfaceDraw{.worldFromSeries = glm::translate(glm::dmat4(1), {x, y, 0})};
    };
    add(sphere({0, 0, 0}, 0.3f, 12), at(-1, -0.6));
    const LinearImage left = renderLinear(frame_);
    frame_.draws.clear();
    add(sphere({0, 0, 0}, 0.3f, 12), at(1.1, 0.7));
    const LinearImage right = renderLinear(frame_);
    add(sphere({0, 0, 0}, 0.3f, 12), at(-1, -0.6));
    const LinearImage both = renderLinear(frame_);
    add(quad(-3, 5),
        {.worldFromSeries = glm::translate(glm::rotate(glm::dmat4(1), M_PI / 2, {1, 0, 0}), {0, 0, 2})});
    const LinearImage behindTheEye = renderLinear(frame_);
    int lines = 0;
    for (std::size_t i = 0; i < both.pixels.size(); ++i) {
        const bool inLeft = left.pixels[i] != kPaper, inRight = right.pixels[i] != kPaper;
        EXPECT_FALSE(inLeft && inRight);
        EXPECT_EQ(both.pixels[i], inLeft ? left.pixels[i] : right.pixels[i]);
        lines += both.pixels[i] != kPaper;
    }
    EXPECT_GT(lines, 100);
    // The wall reaches behind the eye: it is drawn where it is, beyond the boxes of the spheres.
    int wall = 0;
    for (std::size_t i = 0; i < both.pixels.size(); ++i)
        wall += both.pixels[i] == kPaper && behindTheEye.pixels[i] != kPaper;
    EXPECT_GT(wall, 100);
}

/// Moved far out of its box, and with samples beside the pixels' middles: as the same mesh in its place, and
/// as with specks at the corners of the picture, which make all of it worked on.
TEST_F(Drawing, MovedSurfacesAreWorkedOnWhereTheyAre) {
    SurfaceMesh moving = sphere({-0.8f, -0.5f, 0}, 0.25f, 12), moved = sphere({0.8f, 0.5f, 0}, 0.25f, 12);
    moving.velocities.assign(moving.vertexCount(), {3.2f, 2, 0});
    for (const int samples : {1, 3, 4}) {
        frame_.samples = samples;
        frame_.draws.clear();
        add(moved);
        const LinearImage right = renderLinear(frame_);
        frame_.draws.clear();
        add(moving, {.boundsSeries = Bounds{{-2, -2, -1}, {2, 2, 1}}, .motion = 0.5f, .motionLimit = 4});
        const LinearImage found = renderLinear(frame_);
        // Sums of other numbers, off by 2^-23: that moves a rim or a stroke by 10^-5 pixels, and hardly a
        // pixel with it.
        int others = 0;
        for (std::size_t i = 0; i < right.pixels.size(); ++i) others += found.pixels[i] != right.pixels[i];
        EXPECT_LE(others, 1) << samples;
        EXPECT_GT(std::ranges::count_if(found.pixels, [](const glm::vec3& p) { return p != kPaper; }), 60);
        for (const double x : {-1.6, 1.6}) {
            for (const double y : {-1.3, 1.3})
                add(quad(0, 1e-4f), {.worldFromSeries = glm::translate(glm::dmat4(1), {x, y, 0})});
        }
        const LinearImage whole = renderLinear(frame_);
        for (int row = 4; row < 44; ++row) {
            for (int x = 4; x < 56; ++x) EXPECT_EQ(whole.at(x, row), found.at(x, row)) << x << ", " << row;
        }
    }
}

TEST_F(Drawing, LayersAreRefused) {
    frame_.layerDraw.emplace();
    EXPECT_THROW(renderer_.render(frame_), std::invalid_argument);
}

}  // namespace
}  // namespace isoglass::test
