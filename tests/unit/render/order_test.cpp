#include "render_fixture.h"

#include <glm/ext/matrix_transform.hpp>

#include <algorithm>
#include <array>
#include <random>

namespace isoglass::test {
namespace {

using enum TransparencyMethod;

using Triangle = std::array<std::uint32_t, 3>;

/// Two volumes of three surfaces that cut through each other, drawn in random orders.
class Order : public RenderTest {
  protected:
    static constexpr int kPermutations = 50;

    FrameDescription frame_{.camera = {.eye = {3, 2, 2.5}, .fovDegrees = 34, .size = {64, 48}},
                            .background = {0.2f, 0.25f, 0.3f}};
    std::vector<TruthSurface> surfaces_;
    std::mt19937 random_{11};

    void SetUp() override {
        const glm::dmat4 second =
            glm::rotate(glm::translate(glm::dmat4(1), glm::dvec3(0.4, 0.2, -0.1)), 0.7, glm::dvec3(1, 2, 3));
        for (int i = 0; i < 6; ++i) {
            const float share = static_cast<float>(i) / 5;
            surfaces_.push_back({sphere({0, 0, 0}, 0.9f - 0.2f * static_cast<float>(i % 3), 16),
                                 {.worldFromSeries = i < 3 ? glm::dmat4(1) : second,
                                  .color = {share, 1 - share, 0.5f},
                                  .opacity = 0.2f + 0.3f * share}});
        }
        surfaces_[2].draw.opacity = 1;
    }

    LinearImage renderInOrder() {
        for (const SurfaceDraw& draw : frame_.draws) renderer_.meshes().release(draw.mesh);
        frame_.draws.clear();
        show(frame_, surfaces_);
        return renderLinear(frame_);
    }

    void shuffle() {
        std::shuffle(surfaces_.begin(), surfaces_.end(), random_);
        for (TruthSurface& surface : surfaces_) {
            std::vector<Triangle> triangles(surface.mesh.triangleCount());
            std::memcpy(triangles.data(), surface.mesh.triangles.data(), triangles.size() * sizeof(Triangle));
            std::shuffle(triangles.begin(), triangles.end(), random_);
            std::memcpy(surface.mesh.triangles.data(), triangles.data(), triangles.size() * sizeof(Triangle));
        }
    }

    void expectTheSameBits() {
        const LinearImage first = renderInOrder();
        const Image shown = renderer_.readSrgb();
        for (int i = 0; i < kPermutations; ++i) {
            shuffle();
            ASSERT_EQ(renderInOrder().pixels, first.pixels) << "permutation " << i;
            ASSERT_EQ(renderer_.readSrgb().pixels, shown.pixels) << "permutation " << i;
        }
    }
};

TEST_F(Order, ReproducibleThreePassHasTheSameBitsInAny) {
    frame_.method = threePass;
    frame_.reproducible = true;
    expectTheSameBits();
}

TEST_F(Order, ReproducibleFourPassHasTheSameBitsInAny) {
    frame_.method = fourPass;
    frame_.reproducible = true;
    expectTheSameBits();
}

TEST_F(Order, ReproduciblePeelingHasTheSameBitsInAny) {
    frame_.method = peel;
    frame_.layers = 3;
    frame_.reproducible = true;
    expectTheSameBits();
}

TEST_F(Order, ExactHasTheSameBitsInAny) {
    frame_.method = exact;
    expectTheSameBits();
}

/// At most 12 fragments a pixel, whose sum of light and background is at most `sum` there; each order
/// rounds 12 additions and products by 2^-24 of what they reach.
TEST_F(Order, FloatSumsStayWithinTheirRounding) {
    constexpr double kFragments = 12;
    for (const TransparencyMethod method : {threePass, fourPass}) {
        frame_.method = method;
        const LinearImage first = renderInOrder();
        for (int i = 0; i < kPermutations; ++i) {
            shuffle();
            const LinearImage other = renderInOrder();
            for (std::size_t p = 0; p < first.pixels.size(); ++p) {
                const double sum = std::max({1.0f, first.pixels[p].r, first.pixels[p].g, first.pixels[p].b});
                ASSERT_LE(largestDifference(other.pixels[p], first.pixels[p]), kFragments * 0x1p-24 * sum);
            }
        }
    }
}

/// The comparison above would see an order that matters.
TEST_F(Order, BlendingDependsOnIt) {
    frame_.method = twoPass;
    const LinearImage first = renderInOrder();
    std::reverse(surfaces_.begin(), surfaces_.end());
    const LinearImage other = renderInOrder();
    double largest = 0;
    for (std::size_t p = 0; p < first.pixels.size(); ++p) {
        largest = std::max(largest, largestDifference(other.pixels[p], first.pixels[p]));
    }
    EXPECT_GT(largest, 0.05);
}

/// Integer sums are the float sums up to their quanta: a pixel has at most 12 fragments, each rounded to
/// 2^-24 in light and in the logarithm, which the driver knows to 2^-20.
TEST_F(Order, IntegerSumsAreTheFloatSums) {
    for (const TransparencyMethod method : {threePass, fourPass}) {
        frame_.method = method;
        frame_.reproducible = false;
        const LinearImage floats = renderInOrder();
        frame_.reproducible = true;
        const LinearImage integers = renderInOrder();
        for (std::size_t p = 0; p < floats.pixels.size(); ++p) {
            ASSERT_LE(largestDifference(integers.pixels[p], floats.pixels[p]), 12 * 0x1p-20);
        }
    }
}

}  // namespace
}  // namespace isoglass::test
