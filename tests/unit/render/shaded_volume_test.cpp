// A volume as a medium that glows and absorbs: closed forms, and a march on the CPU in double precision.

#include "base/error.h"
#include "layer_fixture.h"
#include "render/transfer_table.h"

#include <limits>

namespace isoglass::test {
namespace {

constexpr glm::vec3 kColor(0.8f, 0.4f, 0.2f), kBackground(0.1f, 0.2f, 0.3f);
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

/// The part of a ray in the box [-1,1]^3; nothing where it passes.
std::optional<std::pair<double, double>> partInBox(const Ray& ray) {
    double begin = 0, end = 1e300;
    for (int k = 0; k < 3; ++k) {
        const double a = (-1 - ray.origin[k]) / ray.direction[k], b = (1 - ray.origin[k]) / ray.direction[k];
        begin = std::max(begin, std::min(a, b));
        end = std::min(end, std::max(a, b));
    }
    return begin < end ? std::optional(std::pair(begin, end)) : std::nullopt;
}

class ShadedVolume : public VolumeTest {
  protected:
    void SetUp() override {
        VolumeTest::SetUp();
        frame_.background = kBackground;
        frame_.shadedDraw.emplace();
        style() = {.colors = {{0, kColor}}, .opacities = {{0, 0.5f}}, .unit = 0.5, .lit = false};
    }

    VolumeDraw& volume() override { return *frame_.shadedDraw; }
    VolumeStyle& style() { return frame_.shadedDraw->style; }

    /// What a ray shows that goes a way of optical depth `depth` through one colour.
    static glm::dvec3 behind(double depth) {
        return glm::mix(glm::dvec3(kColor), glm::dvec3(kBackground), std::exp(-depth));
    }

    /// The same sum as in the shader, over the same steps; also where light ends early.
    glm::dvec3 march(const Ray& ray) {
        glm::dvec3 color(0);
        double through = 1;
        const auto part = partInBox(ray);
        const glm::dvec3 cells(dims() - 1);
        const double step = style().step / glm::length(ray.direction * cells / 2.0);
        for (double t = part ? part->first : 1; part && t < part->second; t += step) {
            const double length = std::min(step, part->second - t);
            const double f = valueAt((ray.origin + (t + length / 2) * ray.direction + 1.0) * cells / 2.0);
            if (std::isnan(f)) continue;
            const glm::dvec4 medium(transferAt(style(), f));
            const double passed = std::pow(1 - medium.a, length / *style().unit);
            color += through * (1 - passed) * glm::dvec3(medium);
            through *= passed;
        }
        return color + through * glm::dvec3(kBackground);
    }

    double valueAt(const glm::dvec3& index) {
        const double a = trilinear(first_, index);
        return a + static_cast<double>(volume().fraction) * (trilinear(second_, index) - a);
    }

    Ray rayOf(int x, int y) const { return pixelRay(frame_.camera, x + 0.5, y + 0.5); }

    /// Largest difference from `right` over all pixels.
    template <typename Right>
    double largestError(Right right) {
        const LinearImage image = renderLinear(frame_);
        double largest = 0;
        forEachPixel([&](int x, int y, std::size_t at) {
            largest = std::max(largest, largestDifference(image.pixels[at], right(rayOf(x, y))));
        });
        return largest;
    }
};

/// Light ends where less than half a step of 8 bits comes through; ways in the box are sums of up to 256
/// numbers of single precision.
constexpr double kEarly = 0.5 / (255 * 12.92), kRounding = 256 * 0x1p-23;
/// Seen from 1000 away, places are off by a few times 1000 * 2^-24, which changes light by up to 1.4 times
/// that.
constexpr double kFarAway = 8 * 1000 * 0x1p-24;

TEST_F(ShadedVolume, AnEvenMediumFollowsTheLawOfBeerAndLambert) {
    setLattice({9, 17, 33});
    upload(sampled([](const glm::dvec3&) { return 3; }));
    for (const double step : {8.0, 1.0, 0.3}) {
        style().step = step;
        const double error = largestError([&](const Ray& ray) {
            const auto part = partInBox(ray);
            return behind(part ? std::log(2) * (part->second - part->first) / 0.5 : 0);
        });
        EXPECT_LT(error, kEarly + kRounding) << step;
    }
}

/// Also opacities far below 2^-24, the distance of floats below 1.
TEST_F(ShadedVolume, ThinMediaKeepTheirOpacity) {
    setLattice({9, 9, 65});
    frame_.camera = fromAbove(9, {4, 4});
    frame_.camera.fovDegrees = 0.02;
    upload(sampled([](const glm::dvec3&) { return 1; }));
    for (const double opacity : {1e-2, 1e-4, 1e-6, 6e-10}) {
        style().opacities = {{0, static_cast<float>(opacity)}};
        // The way is 2: what comes through is half.
        style().unit = 2 / (std::log(0.5) / std::log1p(-static_cast<double>(style().opacities[0].opacity)));
        for (const glm::vec3& pixel : renderLinear(frame_).pixels)
            EXPECT_LT(largestDifference(pixel, behind(std::log(2))), kEarly + kRounding) << opacity;
    }
}

/// Colours are linear along the ray, and taken at the middles of steps: what that lacks of the integral falls
/// with the square of the step, by 4 for each halving (3.5 leaves room for the next power).
TEST_F(ShadedVolume, ConvergesWithTheSquareOfTheStep) {
    setLattice({33, 33, 33});
    frame_.camera = {.eye = {9, 0.1, 0.2}, .fovDegrees = 8, .size = {12, 12}};
    upload(sampled([](const glm::dvec3& p) { return p.x; }));
    style().colors = {{-1, {1, 0, 0}}, {1, {0, 0, 1}}};
    style().opacities = {{-1, 0.3f}, {1, 0.3f}};
    style().step = 1.0 / 32;
    const LinearImage fine = renderLinear(frame_);
    const auto off = [&](double step) {
        style().step = step;
        const LinearImage image = renderLinear(frame_);
        double sum = 0;
        for (std::size_t i = 0; i < image.pixels.size(); ++i)
            sum += largestDifference(image.pixels[i], glm::dvec3(fine.pixels[i]));
        return sum / static_cast<double>(image.pixels.size());
    };
    const double eight = off(8), four = off(4), two = off(2);
    EXPECT_GT(eight / four, 3.5);
    EXPECT_GT(four / two, 3.5);
}

TEST_F(ShadedVolume, FollowsAMarchOnTheCpu) {
    setLattice({20, 17, 23});
    upload(makeVolumeSamples(dims(), randomFloats(dims(), 1)),
           makeVolumeSamples(dims(), randomFloats(dims(), 2)));
    volume().fraction = 0.375f;
    style().colors = {{0.2, {1, 0, 0}}, {0.5, {0, 1, 0}}, {0.8, {0, 0, 1}}};
    style().opacities = {{0.3, 0}, {0.6, 0.6f}, {0.7, 0.1f}};
    // The table is linear between entries 0.6/1023 apart: where the slope of the opacity turns by 7 it is off
    // by up to a quarter of that times the distance, 0.001 of a unit, and a ray crosses at most 7 units.
    // Places on a ray are off by 2^-20 of the box, 2^-16 cells, values by as much, their opacities by 5 and
    // their colors by 3.4 times that.
    EXPECT_LT(largestError([&](const Ray& ray) { return march(ray); }), kEarly + 0.01);
}

TEST_F(ShadedVolume, MissingSamplesAreEmpty) {
    setLattice({17, 17, 17});
    frame_.camera = {.eye = {0.01, 0.02, 9}, .up = {0, 1, 0}, .fovDegrees = 4, .size = {8, 8}};
    upload(sampled([](const glm::dvec3& p) { return std::abs(p.z) < 0.5 ? double{kNan} : 1; }));
    style().step = 0.125;
    // Samples lie 1/8 apart, those at -1/2 and 1/2 are there: beyond them the way is 1/2 on either side.
    // Where values begin and end a step of 1/64 counts whole or not at all.
    const double way = 2 * 0.5;
    const double error = largestError([&](const Ray&) { return behind(std::log(2) * way / 0.5); });
    EXPECT_LT(error, 2 * (1.0 / 64) * std::log(2) / 0.5 + kEarly);
}

/// Bit by bit, also between key frames.
TEST_F(ShadedVolume, BricksThatAreLeftOutChangeNothing) {
    setLattice({60, 43, 51});
    const auto ball = [](double x) {
        return [x](const glm::dvec3& p) { return 1 - 2 * glm::length(p - glm::dvec3(x, 0.2, 0.1)); };
    };
    upload(sampled(ball(-0.4)), sampled(ball(-0.3)));
    volume().fraction = 0.4f;
    style().colors = {{0, {1, 0, 0}}, {1, {1, 1, 0}}};
    style().opacities = {{0, 0}, {1, 0.9f}};
    style().lit = true;
    frame_.lighting = {};
    const LinearImage skipping = renderLinear(frame_);
    const auto all = [](VolumeSamples samples) {
        for (glm::vec2& range : samples.ranges)
            range = {-std::numeric_limits<float>::infinity(), std::numeric_limits<float>::infinity()};
        return samples;
    };
    upload(all(first_), all(second_));
    const LinearImage whole = renderLinear(frame_);
    EXPECT_EQ(
        std::memcmp(skipping.pixels.data(), whole.pixels.data(), whole.pixels.size() * sizeof(glm::vec3)), 0);
    int shown = 0;
    for (const glm::vec3& pixel : whole.pixels) shown += pixel != kBackground;
    EXPECT_GT(shown, 100);
}

/// Seen along the gradient, which is that of the light as well, the medium is lit in full; across it, by the
/// ambient part alone.
TEST_F(ShadedVolume, LightFallsAlongTheGradient) {
    setLattice({17, 17, 17});
    upload(sampled([](const glm::dvec3& p) { return p.x; }));
    style().colors = {{0, {1, 1, 1}}};
    style().opacities = {{0, 1}};
    style().lit = true;
    frame_.lighting = {.ambient = 0.25f, .diffuse = 0.5f, .specular = 0, .shininess = 1};
    frame_.camera = {.eye = {1e3, 0, 0}, .fovDegrees = 0.01, .size = {4, 4}};
    for (const glm::vec3& pixel : renderLinear(frame_).pixels) EXPECT_NEAR(pixel.x, 0.75, kEarly + kFarAway);
    frame_.camera = {.eye = {0, 1e3, 0}, .fovDegrees = 0.01, .size = {4, 4}};
    for (const glm::vec3& pixel : renderLinear(frame_).pixels) EXPECT_NEAR(pixel.x, 0.25, kEarly + kFarAway);
    // Everywhere the same: nothing to turn away from the light.
    upload(sampled([](const glm::dvec3&) { return 1; }));
    for (const glm::vec3& pixel : renderLinear(frame_).pixels) EXPECT_NEAR(pixel.x, 0.75, kEarly + kFarAway);
}

/// What a medium lets through is shown as long as half a step of 8 bits could come of it, with the exposure.
TEST_F(ShadedVolume, WhatEndsEarlyIsNotSeen) {
    setLattice({9, 9, 65});
    frame_.camera = fromAbove(9, {4, 4});
    frame_.camera.fovDegrees = 0.02;
    upload(sampled([](const glm::dvec3&) { return 1; }));
    style().colors = {{0, {0, 0, 0}}};
    frame_.background = glm::vec3(1);
    for (const auto& [exposure, through] : {std::pair(1.0f, 2 * kEarly), std::pair(8.0f, kEarly / 4)}) {
        frame_.exposure = exposure;
        // The way is 2, four units.
        style().opacities = {{0, static_cast<float>(1 - std::pow(through, 0.25))}};
        for (const glm::vec3& pixel : renderLinear(frame_).pixels) EXPECT_NEAR(pixel.x, through, kRounding);
    }
}

/// Along the diagonal of 2,047 x 2,047 cells. Finer steps than a tenth of one Mesa's software renderer would
/// end after 32,767 of them, here 28,949.
TEST_F(ShadedVolume, LongRaysReachTheirEnds) {
    setLattice({2048, 2048, 2});
    upload(sampled([](const glm::dvec3&) { return 1; }));
    frame_.camera = {.eye = {1e3, 1e3, 0}, .fovDegrees = 0.001, .size = {1, 1}};
    style().unit = std::sqrt(8);
    style().step = 0.1;
    // What each step lets through is rounded, by 2^-24 of at most 1.
    EXPECT_LT(largestDifference(renderLinear(frame_).pixels[0], behind(std::log(2))),
              28949 * 0x1p-24 + kFarAway);
}

TEST_F(ShadedVolume, OpaqueSurfacesEndTheWayThroughIt) {
    setLattice({9, 9, 9});
    frame_.camera = fromAbove(1000, {8, 8});
    frame_.camera.fovDegrees = 0.02;
    upload(sampled([](const glm::dvec3&) { return 1; }));
    const glm::vec3 quadColor(0.6f, 0.5f, 0.1f);
    show(frame_, {{quad(0.25f, 3), {.color = quadColor}}});
    const double through = std::pow(0.5, 0.75 / 0.5);
    const glm::dvec3 right = glm::mix(glm::dvec3(kColor), glm::dvec3(quadColor), through);
    for (const glm::vec3& pixel : renderLinear(frame_).pixels)
        EXPECT_LE(largestDifference(pixel, right), kFarAway);
    EXPECT_TRUE(renderer_.plan().runs(PassKind::shadedVolume));
}

TEST_F(ShadedVolume, PlanesCutIt) {
    setLattice({9, 9, 9});
    frame_.camera = fromAbove(1000, {8, 8});
    frame_.camera.fovDegrees = 0.02;
    upload(sampled([](const glm::dvec3&) { return 1; }));
    volume().planes = {{0, 0, 1, 0.5}, {0, 0, -1, 0.25}};
    for (const glm::vec3& pixel : renderLinear(frame_).pixels)
        EXPECT_LE(largestDifference(pixel, behind(std::log(2) * 0.75 / 0.5)), kFarAway);
    volume().planes.assign(kMostVolumePlanes + 1, {1, 0, 0, 1});
    EXPECT_THROW(renderer_.render(frame_), Error);
}

/// Steps three to one, of the same field: what is wrong is a step's length, where its middle lies, or its
/// brick.
TEST_F(ShadedVolume, UnevenAxesAreMapped) {
    setLattice({41, 41, 41});
    const auto field = [](const glm::dvec3& p) { return 1 - glm::length(p); };
    style().opacities = {{0.1, 0}, {0.8, 0.8f}};
    style().step = 0.25;
    upload(sampled(field));
    const LinearImage even = renderLinear(frame_);
    for (std::size_t k = 0; k < 3; ++k) {
        for (double& x : volume().axes[k]) x = x + 0.15 * std::sin(M_PI * x) * (k == 1 ? -1 : 1);
    }
    upload(sampled(field));
    const LinearImage uneven = renderLinear(frame_);
    // Linear between samples 1/20 apart the distance is off by h^2 / 8 of its second derivative 2/r, at most
    // where the opacity begins, at r = 0.2: 0.003; times 1.5 squared. Opacity rises by 1.2 a value, and a way
    // of 1.4 is 3 units.
    for (std::size_t i = 0; i < even.pixels.size(); ++i)
        EXPECT_LE(largestDifference(uneven.pixels[i], glm::dvec3(even.pixels[i])), 2 * 0.007 * 1.2 * 3) << i;
}

TEST_F(ShadedVolume, OneStyleAFrame) {
    frame_.layerDraw.emplace();
    EXPECT_THROW(renderer_.render(frame_), std::invalid_argument);
}

TEST(TransferTable, HasTheFunctionAtItsEntries) {
    const VolumeStyle style{.colors = {{2, {1, 0, 0}}, {4, {0, 1, 0}}},
                            .opacities = {{1, 0.25f}, {5, 0.75f}}};
    const TransferTable table = makeTransferTable(style);
    ASSERT_EQ(table.entries.size(), static_cast<std::size_t>(TransferTable::kEntries));
    EXPECT_EQ(table.low, 1);
    EXPECT_EQ(table.scale, 1023.0f / 4);
    EXPECT_EQ(table.entries.front(), glm::vec4(1, 0, 0, 0.25f));
    EXPECT_EQ(table.entries.back(), glm::vec4(0, 1, 0, 0.75f));
    for (int i = 0; i < TransferTable::kEntries; ++i)
        EXPECT_EQ(table.entries[static_cast<std::size_t>(i)], transferAt(style, 1 + 4.0 * i / 1023));
}

/// Every range of values that has an opacity somewhere is visible; nearly all others are not.
TEST(TransferTable, KnowsWhichRangesAreVisible) {
    const VolumeStyle style{.colors = {{0, {1, 1, 1}}},
                            .opacities = {{0, 0}, {0.3, 0}, {0.4, 1}, {0.5, 0}, {1, 0}}};
    const TransferTable table = makeTransferTable(style);
    constexpr int kBins = TransferTable::kBins;
    for (int a = 0; a < kBins; ++a) {
        for (int b = 0; b < kBins; ++b) {
            const bool visible = table.visible[static_cast<std::size_t>(a * kBins + b)] > 0;
            const double low = static_cast<double>(a) / kBins, high = static_cast<double>(b + 1) / kBins;
            if (a <= b && low < 0.5 && high > 0.3) {
                EXPECT_TRUE(visible) << a << ", " << b;
            }
            if (a > b || low > 0.5 + 2.0 / kBins || high < 0.3 - 2.0 / kBins) {
                EXPECT_FALSE(visible) << a << ", " << b;
            }
        }
    }
}

}  // namespace
}  // namespace isoglass::test
