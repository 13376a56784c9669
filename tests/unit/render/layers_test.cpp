// The traversal against a ray march on the CPU, and its hard cases.

#include "base/error.h"
#include "layer_fixture.h"

#include <zlib.h>

#include <cstdint>
#include <cstdlib>
#include <limits>

namespace isoglass::test {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

class Traversal : public LayerTest {
  protected:
    /// A sample whose distance from the iso-value is below this may fall on either side in single precision:
    /// a place on the ray is a sum of numbers up to 8 cells' worth of box sizes, so off by 2^-20 of the box,
    /// or 2^-20 * 64 cells, where the field changes by at most `slope` a cell; sums of eight products add
    /// 2^-20.
    static double uncertainty(double slope) { return (64 * slope + 1) * 0x1p-20; }

    struct Comparison {
        int certain = 0;
        int layers = 0;  ///< most on a ray
    };

    Comparison expectReference(double slope) {
        const LinearImage found = measure();
        Comparison comparison;
        forEachPixel([&](int x, int y, std::size_t at) {
            const LayerHits hits = reference(x, y);
            if (hits.closest < uncertainty(slope)) return;
            // Where values end is found to a 2^8th of a step of half a cell.
            if (hits.closestAtBorder < slope * 0x1p-9 + uncertainty(slope)) return;
            ++comparison.certain;
            const auto layers = static_cast<int>(hits.depths.size());
            comparison.layers = std::max(comparison.layers, layers);
            EXPECT_EQ(found.pixels[at].g, static_cast<float>(layers)) << x << ", " << y;
        });
        return comparison;
    }

    VolumeSamples noise(std::uint32_t seed, std::uint32_t missingPercent = 0) {
        std::vector<float> values = randomFloats(dims(), seed);
        removeSamples(values, missingPercent, seed + 7);
        return makeVolumeSamples(dims(), std::move(values));
    }

    /// Bit by bit.
    static void expectSame(const LinearImage& a, const LinearImage& b) {
        ASSERT_EQ(a.pixels.size(), b.pixels.size());
        EXPECT_EQ(std::memcmp(a.pixels.data(), b.pixels.data(), a.pixels.size() * sizeof a.pixels[0]), 0);
    }
};

TEST_F(Traversal, CountsLayersOfNoiseAsTheCpuDoes) {
    setLattice({23, 17, 20});
    for (const std::uint32_t seed : {1u, 2u, 3u}) {
        upload(noise(seed));
        draw().iso = 0.5f;
        const Comparison comparison = expectReference(1);
        EXPECT_GT(comparison.certain, 1500);
        EXPECT_GT(comparison.layers, 10);
    }
}

TEST_F(Traversal, CountsLayersBetweenKeyFramesAsTheCpuDoes) {
    setLattice({20, 20, 20});
    upload(noise(4), noise(5));
    draw().iso = 0.5f;
    draw().fraction = 0.375f;
    EXPECT_GT(expectReference(1).layers, 4);
}

/// Four times as many cells along a ray as uncertainty() counts on.
TEST_F(Traversal, CountsLayersOfTheEngineBlockAsTheCpuDoes) {
    const char* data = std::getenv("ISOGLASS_DATA");
    if (data == nullptr) GTEST_SKIP() << "ISOGLASS_DATA is not set";
    const std::string file = std::string(data) + "/static/engine_256x256x128_uint8.raw.gz";
    setLattice({256, 256, 128});
    std::vector<std::uint8_t> bytes(std::size_t{256} * 256 * 128);
    const gzFile packed = gzopen(file.c_str(), "rb");
    ASSERT_NE(packed, nullptr) << file;
    const int read = gzread(packed, bytes.data(), static_cast<unsigned>(bytes.size()));
    gzclose(packed);
    ASSERT_EQ(read, static_cast<int>(bytes.size()));
    upload(makeVolumeSamples(dims(), {bytes.begin(), bytes.end()}));
    draw().iso = 80;
    const Comparison comparison = expectReference(4 * 255);
    EXPECT_GT(comparison.certain, 500);
    EXPECT_GE(comparison.layers, 8);
}

TEST_F(Traversal, MissingSamplesEndALayer) {
    setLattice({20, 20, 20});
    upload(noise(6, 3));
    draw().iso = 0.5f;
    EXPECT_GT(expectReference(1).layers, 3);
}

/// A level surface that ends at a wall of missing samples, seen from above: a ray that meets it in the last
/// bit of a step before the wall meets it all the same.
TEST_F(Traversal, ALayerReachesTheBorderOfWhatIsMissing) {
    setLattice({17, 9, 17});
    frame_.camera = {.eye = {6, 0, 3}, .fovDegrees = 16, .size = {64, 48}};
    upload(sampled([](const glm::dvec3& p) { return p.x < -0.01 ? double{kNan} : -p.z; }));
    draw().iso = 0;
    draw().style.step = 2;
    int columns = 0;
    int crossed = 0;
    forEachPixel([&, found = measure()](int x, int y, std::size_t at) {
        const LayerHits hits = reference(x, y);
        if (hits.closestAtBorder < 0x1p-3 / 256 || hits.closest < uncertainty(1)) return;
        ++columns;
        crossed += !hits.depths.empty();
        EXPECT_EQ(found.pixels[at].g, static_cast<float>(hits.depths.size())) << x << ", " << y;
    });
    EXPECT_GT(columns, 300);
    EXPECT_GT(crossed, 100);
}

/// Two halves on either side of the iso-value with a gap between: nothing is crossed.
TEST_F(Traversal, AGapHidesACrossing) {
    setLattice({33, 9, 9});
    frame_.camera = {.eye = {5, 0, 0}, .fovDegrees = 5, .size = {8, 8}};
    const auto field = [](const glm::dvec3& p) { return std::abs(p.x) < 0.2 ? double{kNan} : p.x; };
    upload(sampled(field));
    draw().iso = 0.1f;
    for (const glm::vec3& pixel : measure().pixels) EXPECT_EQ(pixel.g, 0);
    draw().iso = 0.6f;
    for (const glm::vec3& pixel : measure().pixels) EXPECT_EQ(pixel.g, 1);
}

TEST_F(Traversal, BricksThatAreLeftOutChangeNothing) {
    setLattice({60, 43, 51});
    const auto field = [](const glm::dvec3& p) {
        return std::min(glm::length(p - glm::dvec3(0.4, 0.1, 0)), glm::length(p + glm::dvec3(0.5, 0.2, 0.3)));
    };
    upload(sampled(field));
    draw().iso = 0.3f;
    draw().style.count = 2;
    const LinearImage skipping = measure();
    int shown = 0;
    for (const glm::vec3& pixel : skipping.pixels) shown += pixel.g > 1;
    EXPECT_GT(shown, 100);
    VolumeSamples all = first_;
    int skipped = 0;
    for (glm::vec2& range : all.ranges) {
        skipped += range.x > 0.3f || range.y < 0.3f;
        range = {-std::numeric_limits<float>::infinity(), std::numeric_limits<float>::infinity()};
    }
    EXPECT_GT(skipped, static_cast<int>(all.ranges.size()) / 2);
    upload(all);
    expectSame(skipping, measure());
}

/// Bytes make plateaus, often at a round iso-value. Half of the box is one, in both key frames.
TEST_F(Traversal, APlateauAtTheIsoValueLiesOnOneSide) {
    setLattice({33, 20, 20});
    frame_.camera = {.eye = {6, 1, 2}, .fovDegrees = 12, .size = {48, 40}};
    const auto plateau = [](const glm::dvec3& p) { return p.x < 0 ? 25 + 7 * p.x : 25; };
    upload(sampled(plateau), sampled(plateau));
    draw().iso = 25;
    int rays = 0;
    for (const float fraction : {0.1f, 1.0f / 3, 0.7f}) {
        draw().fraction = fraction;
        forEachPixel([&, found = measure()](int x, int y, std::size_t at) {
            rays += found.pixels[at].g == 1;
            // A ray that leaves through the plateau meets nothing, another one its border at x = 0.
            EXPECT_LE(found.pixels[at].g, 1) << x << ", " << y;
        });
    }
    EXPECT_GT(rays, 500);
}

/// Samples at the iso-value on the floor, less above: every ray that leaves through the floor meets a layer
/// there.
TEST_F(Traversal, ALayerOnTheDomainsFaceIsSeenWhole) {
    setLattice({20, 20, 17});
    frame_.camera = {.eye = {1, 2, 9}, .fovDegrees = 5, .size = {48, 40}};
    upload(sampled([](const glm::dvec3& p) { return -0.3 * (p.z + 1); }),
           sampled([](const glm::dvec3& p) { return -0.7 * (p.z + 1); }));
    draw().iso = 0;
    for (const float fraction : {0.0f, 0.3f}) {
        draw().fraction = fraction;
        for (const glm::vec3& pixel : measure().pixels) EXPECT_EQ(pixel.g, 1);
    }
}

/// Also where the ray ends early, and whichever layer is wanted.
TEST_F(Traversal, StoppingEarlyChangesNoPicture) {
    setLattice({20, 20, 20});
    upload(noise(8));
    draw().iso = 0.5f;
    frame_.lighting = {};
    for (const auto show : {LayerStyle::Show::nth, LayerStyle::Show::blend, LayerStyle::Show::composed,
                            LayerStyle::Show::silhouettes}) {
        for (const int count : {1, 3}) {
            draw().style.show = show;
            draw().style.count = count;
            draw().style.opacities = {0.7f};
            draw().wholeRay = false;
            const LinearImage early = renderLinear(frame_);
            draw().wholeRay = true;
            expectSame(early, renderLinear(frame_));
        }
    }
}

/// The field is the same; only its axes are named from the other end.
TEST_F(Traversal, DescendingAxesShowTheSameLayers) {
    setLattice({24, 20, 18});
    const auto field = [](const glm::dvec3& p) { return glm::length(p - glm::dvec3(0.2, -0.1, 0.3)); };
    upload(sampled(field));
    draw().iso = 0.6f;
    draw().style.count = 1;
    const LinearImage ascending = measure();
    for (const std::size_t k : {0, 2}) std::reverse(draw().axes[k].begin(), draw().axes[k].end());
    upload(sampled(field));
    const LinearImage descending = measure();
    int shown = 0;
    forEachPixel([&](int x, int y, std::size_t at) {
        const LayerHits hits = reference(x, y);
        const Ray ray = pixelRay(frame_.camera, x + 0.5, y + 0.5);
        if (hits.depths.size() != 2) return;
        const double cosine = std::abs(glm::dot(ray.direction, glm::normalize(hits.normals[0])));
        if (cosine < 1.0 / 3) return;
        ++shown;
        // Steps begin at the same place; places on the ray, sums of numbers up to 8, are rounded otherwise,
        // and a surface at that angle is met up to three times as much later.
        EXPECT_NEAR(ascending.pixels[at].r, descending.pixels[at].r, 3 * 8 * 0x1p-21) << x << ", " << y;
    });
    EXPECT_GT(shown, 150);
}

TEST_F(Traversal, PlanesCutLayersAway) {
    setLattice({9, 9, 33});
    frame_.camera = {.eye = {0, 0, 6}, .up = {0, 1, 0}, .fovDegrees = 5, .size = {8, 8}};
    // Crosses 0 at z = -0.8, -0.4, 0, 0.4, 0.8 and nowhere else.
    upload(sampled([](const glm::dvec3& p) { return std::cos(M_PI * (p.z / 0.4 - 0.5)); }));
    draw().iso = 0;
    draw().planes = {{0, 0, -1, 0.6}, {0, 0, 1, 0.6}};
    draw().style.count = 1;
    const LinearImage image = measure();
    for (const glm::vec3& pixel : image.pixels) {
        EXPECT_EQ(pixel.g, 3);
        // A step of the samples is 1/16; linear between them the sine is off by less than (pi/0.4/16)^2/8 =
        // 0.03 of its amplitude, and rises by pi/0.4 = 7.9 a unit.
        EXPECT_NEAR(pixel.r, 6 - 0.4, 0.03 / 7.9);
    }
}

TEST_F(Traversal, OpaqueSurfacesHideWhatIsBehindThem) {
    setLattice({9, 9, 33});
    frame_.camera = fromAbove(6, {8, 8});
    frame_.camera.fovDegrees = 5;
    upload(sampled([](const glm::dvec3& p) { return std::cos(M_PI * (p.z / 0.4 - 0.5)); }));
    draw().iso = 0;
    show(frame_, {{quad(0.2f, 3), {.color = {0.1f, 0.2f, 0.3f}}}});
    for (const glm::vec3& pixel : measure().pixels) EXPECT_EQ(pixel.g, 2);
    // Through layers of opacity 1/2 the surface shows with a quarter of its colour.
    draw().style = {.show = LayerStyle::Show::composed,
                    .count = 5,
                    .colors = {{0.8f, 0, 0}, {0, 0.8f, 0}},
                    .opacities = {0.5f}};
    for (const glm::vec3& pixel : renderLinear(frame_).pixels)
        EXPECT_LE(largestDifference(pixel, {0.4 + 0.025, 0.2 + 0.05, 0.075}), 1e-6);
}

TEST_F(Traversal, SemiTransparentSurfacesLieInFront) {
    setLattice({9, 9, 9});
    frame_.camera = fromAbove(6, {8, 8});
    frame_.camera.fovDegrees = 5;
    upload(sampled([](const glm::dvec3& p) { return p.z; }));
    draw().style = {.show = LayerStyle::Show::nth, .count = 1, .colors = {{0.8f, 0, 0}}};
    show(frame_, {{quad(2, 3), {.color = {0, 0, 1}, .opacity = 0.25f}}});
    for (const glm::vec3& pixel : renderLinear(frame_).pixels)
        EXPECT_LE(largestDifference(pixel, {0.6, 0, 0.25}), 1e-6);
}

/// Half of the pixels of an edge-on box lie beside it: they keep the background, also a transparent one.
TEST_F(Traversal, WhereThereIsNoLayerTheBackgroundStays) {
    setLattice({9, 9, 9});
    upload(sampled([](const glm::dvec3& p) { return glm::length(p); }));
    draw().iso = 0.5f;
    draw().style = {.show = LayerStyle::Show::nth, .count = 1, .colors = {{1, 0, 0}}};
    frame_.background = {0.2f, 0.3f, 0.4f};
    frame_.backgroundOpacity = 0;
    renderer_.render(frame_);
    const Image image = renderer_.readSrgb();
    EXPECT_EQ(image.pixels.front(), (Rgba8{0, 0, 0, 0}));
    const auto middle = static_cast<std::size_t>(20 * 48 + 24);
    EXPECT_EQ(image.pixels[middle], (Rgba8{255, 0, 0, 255}));
}

TEST_F(Traversal, WhereNothingIsCrossedThePictureIsThatWithoutThePass) {
    setLattice({9, 9, 9});
    upload(sampled([](const glm::dvec3& p) { return p.x; }));
    draw().iso = 2;
    frame_.background = {0.2f, 0.3f, 0.4f};
    show(frame_, {{sphere({0.3f, 0, 0}, 0.5f, 8), {}}, {quad(0.1f, 0.8f), {.opacity = 0.5f}}});
    const LinearImage with = renderLinear(frame_);
    EXPECT_TRUE(renderer_.plan().runs(PassKind::layers));
    frame_.layerDraw.reset();
    expectSame(with, renderLinear(frame_));
    EXPECT_FALSE(renderer_.plan().runs(PassKind::layers));
}

/// A thousand boxes away, where places along a ray are off by 2^-10 of the box; then so far that no place on
/// a ray means anything: the frame ends all the same.
TEST_F(Traversal, ACameraFarAwaySeesTheVolume) {
    setLattice({33, 33, 33});
    upload(sampled([](const glm::dvec3& p) { return glm::length(p); }));
    draw().iso = 0.5f;
    const CameraView near = frame_.camera;
    frame_.camera.eye *= 1e3;
    frame_.camera.fovDegrees = 360 / M_PI * std::atan(std::tan(near.fovDegrees * M_PI / 360) / 1e3);
    int met = 0;
    forEachPixel([&, found = measure()](int x, int y, std::size_t at) {
        const Ray ray = pixelRay(frame_.camera, x + 0.5, y + 0.5);
        const double off = glm::length(ray.origin - glm::dot(ray.origin, ray.direction) * ray.direction);
        // Samples are 1/16 apart, so the ball is off by less than (1/16)^2/8 times its curvature 2/0.5 in
        // each axis, 0.006; a chord of a step's length is 0.004 within it.
        if (std::abs(off - 0.5) < 0.02) return;
        met += off < 0.5;
        EXPECT_EQ(found.pixels[at].g, off < 0.5 ? 2 : 0) << x << ", " << y;
    });
    EXPECT_GT(met, 100);
    frame_.camera.eye *= 1e4;
    frame_.camera.fovDegrees = 1e-6;
    measure();
    for (double& x : draw().axes[0]) x = x * x * x;  // uneven
    measure();
}

TEST_F(Traversal, TooManyPlanesAreRefused) {
    setLattice({9, 9, 9});
    upload(sampled([](const glm::dvec3& p) { return p.x; }));
    draw().planes.assign(kMostVolumePlanes + 1, {1, 0, 0, 1});
    EXPECT_THROW(renderer_.render(frame_), Error);
}

}  // namespace
}  // namespace isoglass::test
