#include "render_fixture.h"

#include <algorithm>
#include <numeric>
#include <random>

namespace isoglass::test {
namespace {

constexpr TransparencyMethod kThreePass = TransparencyMethod::threePass;
constexpr TransparencyMethod kFourPass = TransparencyMethod::fourPass;
constexpr TransparencyMethod kEveryMethod[] = {TransparencyMethod::twoPass, kThreePass, kFourPass,
                                               TransparencyMethod::peel, TransparencyMethod::exact};

/// Squares of one size that fill the view, highest first: the fragments of every pixel are known.
struct Layer {
    float z;
    bool facingDown;
    glm::vec3 color;
    float opacity;
};

const glm::vec3 kBackground(0.1f, 0.3f, 0.7f);

std::vector<TruthSurface> surfacesOf(const std::vector<Layer>& layers) {
    std::vector<TruthSurface> surfaces;
    for (const Layer& layer : layers) {
        surfaces.push_back(
            {quad(layer.z, 8, layer.facingDown), {.color = layer.color, .opacity = layer.opacity}});
    }
    return surfaces;
}

glm::dvec3 closedForm(const std::vector<Layer>& layers, TransparencyMethod method) {
    std::vector<Fragment> fragments;
    for (std::size_t i = 0; i < layers.size(); ++i) {
        const Layer& layer = layers[i];
        fragments.push_back({10.0 - layer.z, layer.facingDown, i, layer.color, layer.opacity});
    }
    return compose(fragments, kBackground, method);
}

/// k semi-transparent layers, every third one facing away.
std::vector<Layer> stack(int k) {
    std::vector<Layer> layers;
    for (int i = 0; i < k; ++i) {
        const float share = static_cast<float>(i + 1) / static_cast<float>(k + 1);
        layers.push_back({1.0f - 0.1f * static_cast<float>(i),
                          i % 3 == 2,
                          {share, 1 - share, 0.5f * share},
                          0.15f + 0.5f * share});
    }
    return layers;
}

class Planes : public RenderTest {
  protected:
    FrameDescription frameOf(const std::vector<Layer>& layers, TransparencyMethod method) {
        FrameDescription frame{.camera = fromAbove(10), .background = kBackground, .lighting = kUnlit};
        frame.method = method;
        show(frame, surfacesOf(layers));
        return frame;
    }

    /// Every pixel, the edge between the two triangles included. 1e-4 is what the methods promise; the float
    /// error of k layers is k 2^-24.
    void expectClosedForm(const std::vector<Layer>& layers, TransparencyMethod method) {
        const glm::dvec3 expected = closedForm(layers, method);
        const LinearImage image = renderLinear(frameOf(layers, method));
        for (int i = 0; i < 32 * 32; ++i) {
            const glm::vec3& pixel = image.at(i % 32, i / 32);
            ASSERT_LT(largestDifference(pixel, expected), 1e-4)
                << "pixel " << i % 32 << "," << i / 32 << ": " << pixel.r << " " << pixel.g << " " << pixel.b
                << " instead of " << expected.r << " " << expected.g << " " << expected.b;
        }
    }
};

TEST_F(Planes, StacksGiveTheClosedFormOfEveryMethod) {
    for (const TransparencyMethod method : kEveryMethod) {
        for (const int k : {1, 2, 3, 5, 8, 9, 17, 20}) expectClosedForm(stack(k), method);
    }
}

TEST_F(Planes, TheBackFaceThatLimitsEmissionEmitsItself) {
    const std::vector<Layer> layers{{1, true, {0.9f, 0.1f, 0.2f}, 0.5f}, {0, false, {0, 1, 0}, 0.5f}};
    const glm::dvec3 expected = 0.25 * glm::dvec3(kBackground) + 0.5 * glm::dvec3(layers[0].color);
    EXPECT_LT(glm::length(closedForm(layers, kFourPass) - expected), 1e-12);
    expectClosedForm(layers, kFourPass);
}

TEST_F(Planes, AnOpaqueLayerHidesWhatIsBehindAndIsAttenuatedByWhatIsBefore) {
    for (const TransparencyMethod method : kEveryMethod) {
        for (const std::size_t place : {0u, 2u, 5u}) {
            std::vector<Layer> layers = stack(5);
            const float z = 1.05f - 0.1f * static_cast<float>(place);
            layers.insert(layers.begin() + static_cast<std::ptrdiff_t>(place),
                          {z, place == 2, {0.8f, 0.6f, 0.1f}, 1});
            expectClosedForm(layers, method);
        }
    }
}

TEST_F(Planes, AnOpaqueBackFaceDoesNotLimitEmission) {
    expectClosedForm({{1, false, {1, 0, 0}, 0.4f}, {0, true, {0, 0, 1}, 1}}, kFourPass);
}

TEST_F(Planes, WithoutBackFacesFourPassIsThreePass) {
    const std::vector<Layer> layers{{1, false, {1, 0, 0}, 0.4f}, {0.5f, false, {0, 1, 0}, 0.3f}};
    const LinearImage three = renderLinear(frameOf(layers, kThreePass));
    const LinearImage four = renderLinear(frameOf(layers, kFourPass));
    EXPECT_EQ(three.pixels, four.pixels);
}

TEST_F(Planes, AnInvisibleSurfaceNeitherDimsNorHides) {
    std::vector<Layer> layers{{1, true, {1, 1, 1}, 0}, {0, false, {0, 1, 0}, 0.5f}};
    const LinearImage with = renderLinear(frameOf(layers, kFourPass));
    layers.erase(layers.begin());
    EXPECT_EQ(with.pixels, renderLinear(frameOf(layers, kFourPass)).pixels);
}

/// Two orders of n products or sums each round n - 1 times, by at most 2^-24 of the partial result, which
/// is at most B + sum e; the resolve rounds twice more: 2 (n + 1) 2^-24 (B + sum e) between two orders.
TEST_F(Planes, TheOrderOfDrawsDoesNotMatter) {
    const int n = 12;
    for (const TransparencyMethod method : {kThreePass, kFourPass}) {
        FrameDescription frame = frameOf(stack(n), method);
        const LinearImage first = renderLinear(frame);
        double largest = glm::length(kBackground);
        for (const SurfaceDraw& draw : frame.draws) largest += draw.opacity * glm::length(draw.color);
        std::mt19937 random(3);
        for (int trial = 0; trial < 5; ++trial) {
            std::shuffle(frame.draws.begin(), frame.draws.end(), random);
            const LinearImage other = renderLinear(frame);
            for (std::size_t i = 0; i < first.pixels.size(); ++i) {
                ASSERT_LE(largestDifference(first.pixels[i], other.pixels[i]),
                          2 * (n + 1) * 0x1p-24 * largest);
            }
        }
    }
}

}  // namespace
}  // namespace isoglass::test
