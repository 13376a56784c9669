#include "render/sample_positions.h"
#include "render_fixture.h"

namespace isoglass::test {
namespace {

using enum TransparencyMethod;

TEST(SamplePositions, OfOnePictureAreTheCenter) {
    EXPECT_EQ(samplePosition(0, 1), glm::dvec2(0));
}

TEST(SamplePositions, AreSpreadOverTheCellAroundItsCenter) {
    for (const int count : {2, 3, 7, 16, 64}) {
        glm::dvec2 sum(0);
        for (int i = 0; i < count; ++i) {
            const glm::dvec2 position = samplePosition(i, count);
            EXPECT_LE(std::max(std::abs(position.x), std::abs(position.y)), 0.5 + 0.5 / count) << count;
            sum += position;
            for (int j = 0; j < i; ++j) {
                // Columns are 1/count apart, so no two samples meet.
                EXPECT_GE(std::abs(position.x - samplePosition(j, count).x), 0.999 / count);
            }
        }
        EXPECT_LT(glm::length(sum), 1e-12 * count);
    }
}

/// The share of a pixel that a half plane covers, by many samples: the edge of a large square runs through
/// every row at a slant.
class Samples : public RenderTest, public testing::WithParamInterface<TransparencyMethod> {
  protected:
    FrameDescription frame_{
        .camera = fromAbove(10, {24, 24}), .background = {0, 0, 0}, .lighting = kUnlit, .method = GetParam()};

    double errorWith(int samples) {
        constexpr double kSlope = 0.3;
        SurfaceMesh mesh = quad(0, 20);
        // Left edge through the image's center, slanting.
        mesh.positions[0] = {-20 * kSlope, -20, 0};
        mesh.positions[3] = {20 * kSlope, 20, 0};
        frame_.samples = samples;
        frame_.draws.clear();
        show(frame_, {{mesh, {.color = {1, 1, 1}, .opacity = 0.5f}}});
        const LinearImage image = renderLinear(frame_);
        double sum = 0;
        for (int y = 0; y < 24; ++y) {
            for (int x = 0; x < 24; ++x) sum += std::abs(image.at(x, y).r - 0.5 * coverage(x, y, kSlope));
        }
        return sum / (24 * 24);
    }

    /// Share of pixel (x, y) on the right of the line x = slope * y through the middle, in the pixel's own
    /// units: 4096 points.
    static double coverage(int x, int y, double slope) {
        int inside = 0;
        for (int i = 0; i < 64 * 64; ++i) {
            const double px = x - 12 + (i % 64 + 0.5) / 64;
            const double py = 12 - y - (i / 64 + 0.5) / 64;
            inside += px > slope * py;
        }
        return inside / 4096.0;
    }
};

TEST_P(Samples, AverageTowardsTheCoverage) {
    const double one = errorWith(1);
    const double four = errorWith(4);
    const double fiveJittered = errorWith(5);
    const double many = errorWith(64);
    EXPECT_GT(one, 4e-3);
    EXPECT_LT(four, one / 1.8);
    EXPECT_LT(fiveJittered, one / 1.8);
    // A point set of 64 in a pixel: its columns are 1/16 of half a pixel apart and the edge is straight.
    EXPECT_LT(many, one / 12);
}

TEST_P(Samples, LeaveAUniformColorAsItIs) {
    for (const int samples : {2, 3, 4, 8, 12, 33}) {
        FrameDescription frame{
            .camera = fromAbove(1, {5, 3}), .background = {0.1f, 0.7f, 0.3f}, .method = GetParam()};
        frame.samples = samples;
        for (const glm::vec3& pixel : renderLinear(frame).pixels) {
            // Adding up n equal numbers rounds n times, the share once more.
            ASSERT_LE(largestDifference(pixel, frame.background), (samples + 1) * 0x1p-24) << samples;
        }
    }
}

/// Opaque colors are averaged before the sRGB curve: half black, half white is linear 0.5.
TEST_P(Samples, AreAveragedInLinearLight) {
    FrameDescription frame{.camera = fromAbove(10, {8, 8}), .lighting = kUnlit, .method = GetParam()};
    SurfaceMesh half = quad(0, 20);
    half.positions[0].x = half.positions[3].x = 0;
    frame.camera.size = {9, 9};  // the middle column is cut in two
    show(frame, {{half, {.color = {1, 1, 1}}}});
    frame.samples = 4;
    frame.keepLinear = false;
    renderer_.render(frame);
    EXPECT_NEAR(renderer_.readSrgb().at(4, 4).r, 188, 1);  // 255 (1.055 0.5^(1/2.4) - 0.055) = 187.5
}

INSTANTIATE_TEST_SUITE_P(Methods, Samples, testing::Values(twoPass, threePass, fourPass, peel, exact),
                         [](const auto& method) {
                             return "method" + std::to_string(static_cast<int>(method.param));
                         });

}  // namespace
}  // namespace isoglass::test
