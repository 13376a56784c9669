#include "render_fixture.h"

#include <optional>

namespace isoglass::test {
namespace {

struct Ball {
    glm::dvec3 center;
    double radius;
    glm::vec3 color;
    float opacity;
};

constexpr int kRings = 96;
const glm::vec3 kBackground(0.2f, 0.25f, 0.3f);

/// Shells one in another, the innermost opaque, and a small one of them off center.
const std::vector<Ball> kNested{
    {{0, 0, 0}, 1.0, {0.1f, 0.3f, 0.9f}, 0.3f},       {{0.05, 0, 0}, 0.8, {0.1f, 0.8f, 0.2f}, 0.4f},
    {{0, 0.1, 0}, 0.55, {0.9f, 0.7f, 0.1f}, 0.5f},    {{0.3, -0.2, 0.1}, 0.15, {0.8f, 0.1f, 0.7f}, 0.6f},
    {{0, 0.1, -0.1}, 0.25, {0.8f, 0.1f, 0.1f}, 1.0f},
};

/// How far the flat patches lie inside the sphere: the sagitta of half a patch's diagonal, with sides of
/// pi/rings each way, R (1 - cos(angle)).
double sagitta(double radius) {
    return radius * (1 - std::cos(M_PI / kRings / std::sqrt(2.0)));
}

/// Fragments of a pixel, nothing where a silhouette may pass through it: where the ray's distance from a
/// center is within the sagitta and half a pixel's diagonal (at the ball's far side) of the radius.
std::optional<std::vector<Fragment>> fragmentsAt(const CameraView& camera, int x, int y) {
    const Ray ray = pixelRay(camera, x + 0.5, y + 0.5);
    const double pixel = 2 * std::tan(glm::radians(camera.fovDegrees) / 2) / camera.size.y;
    std::vector<Fragment> fragments;
    for (std::size_t i = 0; i < kNested.size(); ++i) {
        const Ball& ball = kNested[i];
        const double along = glm::dot(ball.center - ray.origin, ray.direction);
        const double distance = glm::length(ray.origin + along * ray.direction - ball.center);
        const double margin = sagitta(ball.radius) + pixel * (along + ball.radius) / std::sqrt(2.0);
        if (std::abs(distance - ball.radius) < margin) return std::nullopt;
        if (distance > ball.radius) continue;
        const double half = std::sqrt(ball.radius * ball.radius - distance * distance);
        fragments.push_back({along - half, false, i, ball.color, ball.opacity});
        fragments.push_back({along + half, true, i, ball.color, ball.opacity});
    }
    return fragments;
}

/// Spheres that touch the same ray in depths closer than both sagittas could swap.
bool orderIsCertain(const std::vector<Fragment>& fragments) {
    for (const Fragment& a : fragments) {
        for (const Fragment& b : fragments) {
            const double gap = std::abs(a.distance - b.distance);
            // Along the ray, the surface may move by the sagitta over the cosine of incidence, here below 8.
            if (a.draw < b.draw && gap < 8 * (sagitta(1) + sagitta(1))) return false;
        }
    }
    return true;
}

class Spheres : public RenderTest, public testing::WithParamInterface<TransparencyMethod> {};

TEST_P(Spheres, PixelsAreThoseOfTheClosedFormAwayFromSilhouettes) {
    FrameDescription frame{.camera = {.eye = {3, 2, 2.5}, .fovDegrees = 34, .size = {160, 120}},
                           .background = kBackground,
                           .lighting = kUnlit,
                           .method = GetParam()};
    std::vector<TruthSurface> surfaces;
    for (const Ball& ball : kNested) {
        surfaces.push_back({sphere(ball.center, static_cast<float>(ball.radius), kRings),
                            {.color = ball.color, .opacity = ball.opacity}});
    }
    show(frame, surfaces);
    const LinearImage image = renderLinear(frame);
    int compared = 0;
    int deepest = 0;
    for (int y = 0; y < image.size.y; ++y) {
        for (int x = 0; x < image.size.x; ++x) {
            const auto fragments = fragmentsAt(frame.camera, x, y);
            if (!fragments || !orderIsCertain(*fragments)) continue;
            ++compared;
            deepest = std::max(deepest, static_cast<int>(fragments->size()));
            ASSERT_LT(largestDifference(image.at(x, y), compose(*fragments, kBackground, GetParam())), 1e-4)
                << "pixel " << x << "," << y << " with " << fragments->size() << " fragments";
        }
    }
    EXPECT_GT(compared, image.size.x * image.size.y * 3 / 4);
    // Three shells, and behind them the small one or the opaque one.
    EXPECT_EQ(deepest, 8);
}

std::string testName(const testing::TestParamInfo<TransparencyMethod>& method) {
    constexpr std::array kNames{"automatic", "twoPass", "threePass", "fourPass", "peel", "exact"};
    return kNames[static_cast<std::size_t>(method.param)];
}

INSTANTIATE_TEST_SUITE_P(Methods, Spheres,
                         testing::Values(TransparencyMethod::threePass, TransparencyMethod::fourPass,
                                         TransparencyMethod::peel, TransparencyMethod::exact),
                         testName);

}  // namespace
}  // namespace isoglass::test
