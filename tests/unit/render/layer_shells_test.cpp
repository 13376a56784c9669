// Nested spherical shells, whose layers are known in closed form: f = cos(w (r - 0.1)) crosses 0 at 0.2, 0.4,
// ...

#include "layer_fixture.h"

#include <numbers>

namespace isoglass::test {
namespace {

constexpr int kSamples = 161;
constexpr double kStep = 2.0 / (kSamples - 1);
/// Four shells: radii 0.2, 0.4, 0.6, 0.8.
constexpr double kBetween = 0.2;
constexpr double kW = std::numbers::pi / kBetween;
constexpr int kShells = 4;

double shells(const glm::dvec3& p) {
    // Flat beyond the last shell, where the cosine has its maximum.
    const double r = std::min(glm::length(p), kBetween * (kShells + 0.5));
    return std::cos(kW * (r - kBetween / 2));
}

/// Between samples the field is off by at most h^2/8 in each of three axes times the second derivative, w^2
/// along the radius and w/r across it, and at a crossing rises by w a unit of the radius.
constexpr double kRadiusError = kStep * kStep / 8 * (kW * kW + 2 * kW / kBetween) / kW;

/// Distances of up to 8 are sums of a few numbers in single precision.
constexpr double kRounding = 10 * 0x1p-21;

struct Hit {
    double distance;  ///< along the ray
    double cosine;    ///< of the angle between ray and normal
};

/// What a ray from `eye` meets, near to far; nothing where it passes a shell too flatly to be certain.
std::optional<std::vector<Hit>> hitsOf(const Ray& ray) {
    std::vector<Hit> hits;
    const double along = -glm::dot(ray.origin, ray.direction);
    const double off = glm::length(ray.origin + along * ray.direction);
    for (int i = 1; i <= kShells; ++i) {
        const double radius = kBetween * i;
        const double cosine = std::sqrt(std::max(0.0, 1 - off * off / (radius * radius)));
        // A chord shorter than a few steps of the ray may be missed.
        if (std::abs(off - radius) < 3 * kRadiusError || (off < radius && cosine * radius < 2 * kStep))
            return std::nullopt;
        if (off > radius) continue;
        for (const double side : {-1.0, 1.0}) {
            const double distance = along + side * radius * cosine;
            if (distance > 0) hits.push_back({distance, cosine});
        }
    }
    std::ranges::sort(hits, {}, &Hit::distance);
    return hits;
}

class Shells : public LayerTest {
  protected:
    void SetUp() override {
        LayerTest::SetUp();
        setLattice(glm::ivec3(kSamples));
        upload(sampled(shells));
        draw().iso = 0;
        outside_ = frame_.camera;
        inside_ = frame_.camera;
        inside_.eye = {0.1, 0.29, 0.02};  // between the first two shells
        inside_.fovDegrees = 100;
    }

    double cosineToAxis(const Ray& ray) const {
        return glm::dot(ray.direction, glm::normalize(frame_.camera.target - frame_.camera.eye));
    }

    void forEachRay(
        const std::function<void(std::size_t at, const Ray& ray, const std::vector<Hit>& hits)>& act) {
        int rays = 0;
        forEachPixel([&](int x, int y, std::size_t at) {
            const Ray ray = pixelRay(frame_.camera, x + 0.5, y + 0.5);
            const auto hits = hitsOf(ray);
            if (!hits) return;
            ++rays;
            act(at, ray, *hits);
        });
        EXPECT_GT(rays, 500) << "hardly a ray is certain";
    }

    CameraView outside_, inside_;
};

TEST_F(Shells, EveryLayerLiesWhereTheClosedFormSays) {
    for (const CameraView& camera : {outside_, inside_}) {
        frame_.camera = camera;
        for (int layer = 1; layer <= 2 * kShells; ++layer) {
            draw().style.count = layer;
            const LinearImage found = measure();
            int met = 0;
            forEachRay([&](std::size_t at, const Ray& ray, const std::vector<Hit>& hits) {
                ASSERT_EQ(found.pixels[at].g, static_cast<float>(hits.size())) << at;
                const auto index = static_cast<std::size_t>(layer - 1);
                if (index >= hits.size()) {
                    EXPECT_EQ(found.pixels[at].r, 0) << at;
                    return;
                }
                ++met;
                const Hit& hit = hits[index];
                EXPECT_NEAR(found.pixels[at].r / cosineToAxis(ray), hit.distance,
                            kRadiusError / hit.cosine + kRounding)
                    << "layer " << layer << ", pixel " << at;
            });
            if (layer <= 3) {
                EXPECT_GT(met, 50) << layer;
            }
        }
    }
}

/// The gradient of a trilinear field by central differences is off by h^2 (1/6 + 3/8) times the third
/// derivative, at most 2 w^3 here with what bends across the radius, against w; that turns the normal. So
/// does the crossing that lies kRadiusError / cosine off, by that over the radius. A turn changes the cosine
/// by at most itself.
double cosineError(double cosine) {
    return kStep * kStep * (1.0 / 6 + 3.0 / 8) * 2 * kW * kW + kRadiusError / (kBetween * cosine);
}

TEST_F(Shells, EveryLayerIsLitByItsOwnNormal) {
    frame_.lighting = {.ambient = 0, .diffuse = 1, .specular = 0, .shininess = 1};
    draw().style = {.show = LayerStyle::Show::nth, .colors = {{1, 0.5f, 0.25f}}};
    for (const CameraView& camera : {outside_, inside_}) {
        frame_.camera = camera;
        for (int layer = 1; layer <= 2 * kShells; ++layer) {
            draw().style.count = layer;
            const LinearImage found = renderLinear(frame_);
            forEachRay([&](std::size_t at, const Ray&, const std::vector<Hit>& hits) {
                const auto index = static_cast<std::size_t>(layer - 1);
                const double cosine = index < hits.size() ? hits[index].cosine : 0;
                const double tolerance = cosine > 0 ? cosineError(cosine) : 0;
                EXPECT_LE(largestDifference(found.pixels[at], cosine * glm::dvec3(1, 0.5, 0.25)), tolerance)
                    << "layer " << layer << ", pixel " << at;
            });
        }
    }
}

TEST_F(Shells, BlendIsTheMeanOfTheFirstLayers) {
    draw().style = {.show = LayerStyle::Show::blend,
                    .count = 5,
                    .colors = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 0}, {0, 1, 1}, {1, 1, 1}}};
    const LinearImage found = renderLinear(frame_);
    forEachRay([&](std::size_t at, const Ray&, const std::vector<Hit>& hits) {
        glm::dvec3 sum(0);
        const std::size_t shown = std::min<std::size_t>(hits.size(), 5);
        for (std::size_t i = 0; i < shown; ++i) sum += glm::dvec3(draw().style.colors[i]);
        // Five roundings of numbers up to 1.
        EXPECT_LE(largestDifference(found.pixels[at], shown ? sum / static_cast<double>(shown) : sum), 1e-6)
            << at;
    });
}

TEST_F(Shells, ComposedLayersLieOverEachOther) {
    frame_.background = {0.1f, 0.2f, 0.3f};
    draw().style = {.show = LayerStyle::Show::composed,
                    .count = 4,
                    .colors = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 0}},
                    .opacities = {0.25f, 0.5f, 0.75f, 0.125f}};
    const LinearImage found = renderLinear(frame_);
    forEachRay([&](std::size_t at, const Ray&, const std::vector<Hit>& hits) {
        glm::dvec3 wanted(frame_.background);
        for (std::size_t i = std::min<std::size_t>(hits.size(), 4); i-- > 0;) {
            const double opacity = draw().style.opacities[i];
            wanted = opacity * glm::dvec3(draw().style.colors[i]) + (1 - opacity) * wanted;
        }
        EXPECT_LE(largestDifference(found.pixels[at], wanted), 1e-6) << at;
    });
}

TEST_F(Shells, LayersBeforeTheFirstOnlyCount) {
    draw().style = {.show = LayerStyle::Show::blend, .count = 4, .first = 3};
    draw().style.colors = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 0}};
    const LinearImage found = renderLinear(frame_);
    forEachRay([&](std::size_t at, const Ray&, const std::vector<Hit>& hits) {
        glm::dvec3 wanted(0);
        if (hits.size() == 3) wanted = {0, 0, 1};
        if (hits.size() > 3) wanted = {0.5, 0.5, 0.5};
        EXPECT_LE(largestDifference(found.pixels[at], wanted), 1e-6) << at;
    });
}

/// The nearest layer that is seen flatly enough decides; hidden ones are lighter.
TEST_F(Shells, SilhouettesOfTheFirstLayers) {
    draw().style = {.show = LayerStyle::Show::silhouettes, .count = 4, .silhouette = 0.5};
    frame_.background = glm::vec3(1);
    const LinearImage found = renderLinear(frame_);
    std::array<int, 4> shown{};
    forEachRay([&](std::size_t at, const Ray&, const std::vector<Hit>& hits) {
        glm::dvec3 wanted(1);
        for (std::size_t i = std::min<std::size_t>(hits.size(), 4); i-- > 0;) {
            if (std::abs(hits[i].cosine - 0.5) < cosineError(hits[i].cosine)) return;
            if (hits[i].cosine < 0.5) wanted = glm::dvec3(layerColor(draw().style, static_cast<int>(i), {}));
        }
        EXPECT_LE(largestDifference(found.pixels[at], wanted), 1e-6) << at;
        for (std::size_t i = 0; i < 4; ++i)
            shown[i] += wanted == glm::dvec3(layerColor(draw().style, static_cast<int>(i), {}));
    });
    EXPECT_GT(shown[0], 50);
    EXPECT_GT(shown[1], 10) << "no hidden silhouette";
}

/// Uneven steps, three to one: index space is not taken for the world.
TEST_F(Shells, UnevenAxesAreMapped) {
    for (std::size_t k = 0; k < 3; ++k) {
        for (double& x : draw().axes[k]) x = x + 0.15 * std::sin(std::numbers::pi * x) * (k == 1 ? -1 : 1);
    }
    upload(sampled(shells));
    // Steps are at most 1 + 0.15 pi = 1.47 times as long, errors go with their square.
    const double error = 2.2 * kRadiusError;
    draw().style.count = 2;
    const LinearImage found = measure();
    int met = 0;
    forEachRay([&](std::size_t at, const Ray& ray, const std::vector<Hit>& hits) {
        if (hits.size() < 2 || hits[0].cosine < 0.4 || hits[1].cosine < 0.4) return;
        ++met;
        EXPECT_NEAR(found.pixels[at].r / cosineToAxis(ray), hits[1].distance,
                    error / hits[1].cosine + kRounding)
            << at;
    });
    EXPECT_GT(met, 200);
}

/// Placed elsewhere, turned and mirrored, seen by a camera that goes along: from there the shells look the
/// same.
TEST_F(Shells, PlacementMovesTheVolume) {
    const glm::dvec3 away(5e5, -3e5, 2e3);
    const CameraView here = frame_.camera;
    frame_.camera.eye += away;
    frame_.camera.target += away;
    draw().worldFromSeries = glm::dmat4({0, 1, 0, 0}, {-1, 0, 0, 0}, {0, 0, -1, 0}, glm::dvec4(away, 1));
    draw().style.count = 3;
    const LinearImage found = measure();
    frame_.camera = here;
    int met = 0;
    forEachRay([&](std::size_t at, const Ray& ray, const std::vector<Hit>& hits) {
        ASSERT_EQ(found.pixels[at].g, static_cast<float>(hits.size())) << at;
        if (hits.size() < 3) return;
        ++met;
        EXPECT_NEAR(found.pixels[at].r / cosineToAxis(ray), hits[2].distance,
                    kRadiusError / hits[2].cosine + kRounding)
            << at;
    });
    EXPECT_GT(met, 200);
}

}  // namespace
}  // namespace isoglass::test
