#include "numeric/table_row.h"
#include "numeric/view_fixture.h"

#include <cmath>

namespace isoglass::numeric {
namespace {

using test::fromAbove;
using test::kUnlit;
using test::quad;

const glm::vec3 kBackground(0.1f, 0.3f, 0.7f);
constexpr std::array kMethods = {TransparencyMethod::threePass, TransparencyMethod::fourPass};

class NumericLayers : public ViewTest {
  protected:
    FrameDescription frameOf(TransparencyMethod method) const {
        return {.camera = fromAbove(10, {16, 16}),
                .background = kBackground,
                .lighting = kUnlit,
                .method = method};
    }
    /// Every pixel is `expected` but for `tolerance`.
    void expectColor(const FrameDescription& frame, const glm::dvec3& expected, double tolerance) {
        const LinearImage image = renderLinear(frame);
        for (const glm::vec3& pixel : image.pixels)
            ASSERT_LE(test::largestDifference(pixel, expected), tolerance)
                << pixel.r << " " << pixel.g << " " << pixel.b << " instead of " << expected.r << " "
                << expected.g << " " << expected.b;
    }
};

// One mesh, drawn n times at the same place: all fragments of a pixel have the same depth, bit by bit, since
// they come from the same positions and matrices.
TEST_F(NumericLayers, CoincidentSurfacesAllCount) {
    for (const TransparencyMethod method : kMethods) {
        for (const bool facingDown : {false, true}) {
            FrameDescription frame = frameOf(method);
            const MeshId mesh = upload(quad(0, 8, facingDown));
            glm::dvec3 expected(kBackground);
            glm::dvec3 emitted(0);
            for (int i = 0; i < 5; ++i) {
                const glm::vec3 color(0.1f * static_cast<float>(i), 0.5f, 0.3f);
                frame.draws.push_back({.mesh = mesh, .color = color, .opacity = 0.25f});
                expected *= 0.75;
                emitted += 0.25 * glm::dvec3(color);
            }
            // Both sums: the nearest back face is at their own depth and passes <=. 5 products and 5 sums of
            // values below 1: 10 * 2^-24.
            expectColor(frame, expected + emitted, 10 * 0x1p-24);
        }
    }
    addTableRow("CoincidentSurfaces", "depth fighting speckles the picture",
                "five surfaces in one place: the closed form in every pixel, 3- and 4-pass");
}

// Two triangulations of one plane: depths differ by rounding, and no pixel may lose a layer in the sum of
// 3-pass.
TEST_F(NumericLayers, CoplanarSurfacesOfDifferentTriangles) {
    FrameDescription frame = frameOf(TransparencyMethod::threePass);
    SurfaceMesh other = quad(0, 8);
    other.triangles = {0, 1, 3, 1, 2, 3};
    const glm::vec3 red(0.8f, 0, 0);
    const glm::vec3 green(0, 0.8f, 0);
    frame.draws.push_back({.mesh = upload(quad(0, 8)), .color = red, .opacity = 0.5f});
    frame.draws.push_back({.mesh = upload(other), .color = green, .opacity = 0.5f});
    expectColor(frame, 0.25 * glm::dvec3(kBackground) + 0.5 * glm::dvec3(red) + 0.5 * glm::dvec3(green),
                6 * 0x1p-24);
    addTableRow("CoplanarSurfaces", "two triangulations of a plane fight", "both count in every pixel");
}

TEST_F(NumericLayers, OpacitiesZeroAndOneAreExact) {
    for (const TransparencyMethod method : kMethods) {
        FrameDescription frame = frameOf(method);
        const glm::vec3 red(0.8f, 0.1f, 0.2f);
        frame.draws.push_back({.mesh = upload(quad(1, 8)), .color = {1, 1, 1}, .opacity = 0});
        expectColor(frame, kBackground, 0);
        frame.draws.push_back({.mesh = upload(quad(0, 8)), .color = red, .opacity = 1});
        expectColor(frame, red, 0);
        // The smallest and the largest opacity that are neither: 1 - a is 1, or 2^-24.
        frame.draws[0].opacity = 0x1p-149f;
        expectColor(frame, red, 0);
        frame.draws[0].opacity = 1 - 0x1p-24f;
        expectColor(frame, glm::dvec3(1) + 0x1p-24 * glm::dvec3(red), 2 * 0x1p-24);
    }
    addTableRow("OpacityZeroAndOne",
                "a hundredth of the background shines through, or a layer of nothing dims",
                "0 changes no bit, 1 hides to the last bit, 2^-149 and 1 - 2^-24 are handled");
}

// k products round k - 1 times, k sums likewise, each by at most 2^-24 of the partial result, which is at
// most B + sum e (S. Roettger's two sums, no order).
TEST_F(NumericLayers, AThousandLayersGiveTheClosedForm) {
    constexpr int kLayers = 1000;
    double largest = 0;
    for (const float opacity : {0.001f, 0.01f, 0.5f}) {
        FrameDescription frame = frameOf(TransparencyMethod::threePass);
        glm::dvec3 emitted(0);
        double transmittance = 1;
        for (int i = 0; i < kLayers; ++i) {
            const float share = static_cast<float>(i) / kLayers;
            const glm::vec3 color(share, 1 - share, 0.5f);
            frame.draws.push_back(
                {.mesh = upload(quad(1 - 2 * share, 8)), .color = color, .opacity = opacity});
            emitted += static_cast<double>(opacity) * glm::dvec3(color);
            transmittance *= 1 - static_cast<double>(opacity);
        }
        const glm::dvec3 expected = transmittance * glm::dvec3(kBackground) + emitted;
        const double bound = 2 * (kLayers + 1) * 0x1p-24 * (1 + expected.r + expected.g + expected.b);
        expectColor(frame, expected, bound);
        const LinearImage image = renderLinear(frame);
        largest =
            std::max(largest, test::largestDifference(image.at(8, 8), expected) / glm::length(expected));
    }
    addTableRow("AThousandLayers", "8 or 16 bits a channel band and clamp",
                "relative error " + std::to_string(largest) + " of the closed form");
}

}  // namespace
}  // namespace isoglass::numeric
