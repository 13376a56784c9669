// The style "layers" from the series to the picture.

#include "base/error.h"
#include "gl/headless_context.h"
#include "pipeline/batch.h"
#include "pipeline/render_loop.h"
#include "pipeline/scene_samples.h"
#include "support/terrain_lattice.h"
#include "unit/volume/series_fixture.h"

#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace isoglass {
namespace {

constexpr std::size_t kKeyFrames = 3;
constexpr std::int64_t kFrames = 8;

/// A ball that grows evenly with time: its field |p| - 0.2 t is linear in time, so between key frames it is
/// exact. At iso-value 0.3 the radius is 0.3 + 0.2 t.
class SceneLayersTest : public testing::Test {
  protected:
    ScratchFolder folder_;
    Scene scene_;

    void SetUp() override {
        const Lattice lattice = makeUniformLattice(glm::ivec3(41), glm::dvec3(-1), glm::dvec3(0.05));
        std::vector<std::vector<float>> frames;
        for (std::size_t frame = 0; frame < kKeyFrames; ++frame) {
            std::vector<float>& samples = frames.emplace_back();
            for (int z = 0; z < 41; ++z) {
                for (int y = 0; y < 41; ++y) {
                    for (int x = 0; x < 41; ++x) {
                        const double r = glm::length(0.05 * glm::dvec3(x, y, z) - 1.0);
                        samples.push_back(static_cast<float>(r - 0.2 * static_cast<double>(frame)));
                    }
                }
            }
        }
        test::MemorySource source(test::describe(lattice, kKeyFrames), std::move(frames));
        writeSeries(source, folder_ / "ball.vdb");
        Volume volume;
        volume.name = "ball";
        volume.series = folder_ / "ball.vdb";
        volume.surfaces = {{.iso = 0.3, .color = {1, 0, 0}}};
        scene_.volumes = {volume};
        scene_.time = {.from = 0.0, .to = kKeyFrames - 1.0, .duration = kFrames / 25.0, .fps = 25};
        scene_.camera.pose = {.eye = {20, 0, 0}, .target = {0, 0, 0}};
        scene_.camera.fovDegrees = 6;
        scene_.image.size = {96, 96};
        scene_.image.background = LinearColor(0);
        scene_.lighting = {.ambient = 1, .diffuse = 0, .specular = 0, .shininess = 1};
        scene_.layers = LayerStyle{.show = LayerStyle::Show::nth, .count = 1};
    }

    SceneMeshes extract(SceneExtractor& extractor, double position) const {
        return extractor.extract(position, scene_.camera.pose, scene_.image.size);
    }
};

int redPixels(const Image& image) {
    return static_cast<int>(std::ranges::count_if(
        image.pixels, [](const Rgba8& pixel) { return pixel.r == 255 && pixel.g == 0; }));
}

TEST_F(SceneLayersTest, FramesShowTheMomentBetweenKeyFrames) {
    SceneExtractor extractor(scene_, {});
    int frames = 0;
    renderFrames(scene_, extractor, {0, kFrames - 1}, [&](RenderedFrame frame) {
        const double time = static_cast<double>(frame.frame) / kFrames * (kKeyFrames - 1);
        const double radius = 0.3 + 0.2 * time;
        // The cone that touches the ball meets the picture in a circle; half the picture is tan(3 degrees).
        const double seen = std::tan(std::asin(radius / 20)) / std::tan(3 * M_PI / 180) * 48;
        const double area = M_PI * seen * seen;
        // Pixels on the rim may fall on either side: at most those that a ring of the pixel's diagonal
        // covers, and with it what the radius is off between samples, 0.05^2 / 8 * 2 / radius.
        const double off = std::sqrt(0.5) + 0.05 * 0.05 / 4 / radius / radius * seen;
        EXPECT_NEAR(redPixels(frame.image), area, 2 * M_PI * seen * off) << frame.frame;
        EXPECT_TRUE(frame.meshes.surfaces.at(0).mesh->empty()) << "it is not shown, so not extracted";
        ++frames;
        return true;
    });
    EXPECT_EQ(frames, kFrames);
}

class PlayingDirection : public SceneLayersTest, public testing::WithParamInterface<bool> {};

INSTANTIATE_TEST_SUITE_P(Forwards, PlayingDirection, testing::Values(true));
INSTANTIATE_TEST_SUITE_P(Backwards, PlayingDirection, testing::Values(false));

TEST_P(PlayingDirection, EachKeyFrameIsMadeAndUploadedOnce) {
    SceneExtractor extractor(scene_, {});
    gl::HeadlessContext context;
    Renderer renderer(context.context());
    SampleUploads uploads;
    std::set<VolumeId> seen;
    std::set<const VolumeSamples*> made;
    std::vector<SceneSamples> kept;
    for (int i = 0; i <= 20; ++i) {
        const SceneMeshes meshes = extract(extractor, (GetParam() ? i : 20 - i) / 20.0);
        ASSERT_TRUE(meshes.samples);
        kept.push_back(*meshes.samples);
        uploads.replace(meshes.samples, renderer.volumes());
        FrameDescription frame;
        uploads.describe(scene_, 0, frame);
        const auto& draw = frame.layerDraw;
        ASSERT_TRUE(draw);
        seen.insert({draw->first, draw->second});
        made.insert(meshes.samples->first.get());
        if (meshes.samples->second) made.insert(meshes.samples->second.get());
        EXPECT_LE(renderer.volumes().count(), 2u);
        EXPECT_EQ(draw->fraction, static_cast<float>(meshes.times[0].fraction));
    }
    EXPECT_EQ(made.size(), kKeyFrames);
    EXPECT_EQ(seen.size(), kKeyFrames);
    uploads.replace(std::nullopt, renderer.volumes());
    EXPECT_EQ(renderer.volumes().count(), 0u);
    FrameDescription frame;
    uploads.describe(scene_, 0, frame);
    EXPECT_FALSE(frame.layerDraw);
}

TEST_F(SceneLayersTest, OtherSurfacesAreDrawnAsEver) {
    scene_.volumes[0].surfaces.push_back({.iso = 0.1, .color = {0, 1, 0}});
    SceneExtractor extractor(scene_, {});
    const SceneMeshes meshes = extract(extractor, 0.6);
    ASSERT_EQ(meshes.surfaces.size(), 2u);
    EXPECT_TRUE(meshes.surfaces[0].mesh->empty());
    EXPECT_FALSE(meshes.surfaces[1].mesh->empty());
}

TEST_F(SceneLayersTest, WhatIsClippedAwayNeedsNothing) {
    scene_.clip = {{.plane = {0, 0, 1, -5}}};
    SceneExtractor extractor(scene_, {});
    EXPECT_FALSE(extract(extractor, 0.6).samples);
    EXPECT_EQ(extractor.cache().bytes(), 0u);
}

TEST_F(SceneLayersTest, ClipPlanesReachTheRays) {
    scene_.volumes[0].place.translate = {0, 0, 3};
    scene_.clip = {{.plane = {0, 0, 1, -3}}};
    scene_.volumes[0].clip = {{.plane = {1, 0, 0, 0.25}}};
    SceneExtractor extractor(scene_, {});
    const SceneMeshes meshes = extract(extractor, 0);
    ASSERT_TRUE(meshes.samples);
    EXPECT_EQ(meshes.samples->planes, (std::vector<glm::dvec4>{{1, 0, 0, 0.25}, {0, 0, 1, 0}}));
}

TEST_F(SceneLayersTest, SolidsReachTheRays) {
    scene_.volumes[0].place = {.translate = {0, 0, 3}, .scale = {2, 2, 2}};
    scene_.solids = {{SolidShape::sphere, Keep::outside, {.translate = {0, 0, 4}, .scale = {1, 1, 1}}}};
    scene_.volumes[0].solids = {{SolidShape::box, Keep::inside, {.translate = {1, 0, 0}}}};
    SceneExtractor extractor(scene_, {});
    const SceneMeshes meshes = extract(extractor, 0);
    gl::HeadlessContext context;
    Renderer renderer(context.context());
    SampleUploads uploads;
    uploads.replace(meshes.samples, renderer.volumes());
    FrameDescription frame;
    uploads.describe(scene_, 0, frame);
    ASSERT_TRUE(frame.layerDraw);
    const auto& solids = frame.layerDraw->solids;
    ASSERT_EQ(solids.size(), 2u);
    EXPECT_EQ(solids[0],
              (SolidClip{SolidShape::box, Keep::inside, glm::translate(glm::dmat4(1), glm::dvec3(1, 0, 0))}));
    // Half as large in the coordinates of the series, where the middle lies at (4 - 3) / 2.
    EXPECT_EQ(solids[1],
              (SolidClip{SolidShape::sphere, Keep::outside,
                         glm::scale(glm::translate(glm::dmat4(1), glm::dvec3(0, 0, 0.5)), glm::dvec3(0.5))}));
}

/// A cube of edge 2, moved, turned, mirrored and scaled: the longest of its diagonals in the world.
TEST_F(SceneLayersTest, AMediumHasTheUnitOfItsOwnDiagonal) {
    scene_.layers = std::nullopt;
    scene_.volumes[0].surfaces.clear();
    scene_.shaded = VolumeStyle{.colors = {{0, {1, 1, 1}}}, .opacities = {{0, 0.5f}}};
    gl::HeadlessContext context;
    Renderer renderer(context.context());
    const auto unitAt = [&](const Placement& place) {
        scene_.volumes[0].place = place;
        SceneExtractor extractor(scene_, {});
        SampleUploads uploads;
        uploads.replace(extract(extractor, 0.5).samples, renderer.volumes());
        FrameDescription frame;
        uploads.describe(scene_, 0, frame);
        return frame.shadedDraw.value().style.unit.value();
    };
    // A few operations in double precision on coordinates whose steps of 0.05 were rounded.
    const double rounding = 64 * 0x1p-52;
    EXPECT_NEAR(unitAt({}), std::sqrt(12) / 100, rounding);
    EXPECT_NEAR(unitAt({.translate = {5, 6, 7}, .rotate = {1, 2, 3, 40}}), std::sqrt(12) / 100, rounding);
    EXPECT_NEAR(unitAt({.rotate = {0, 0, 1, 45}, .scale = {3, -1, 2}}), std::sqrt(4 * (9 + 1 + 4)) / 100,
                rounding);
}

TEST_F(SceneLayersTest, SeriesWithHeightsAreRefused) {
    const test::TerrainLattice terrain({5, 4, 3}, 0);
    class Source final : public FrameSource {
      public:
        explicit Source(const test::TerrainLattice& of)
            : terrain(of), series(test::describe(of.lattice, 1)) {}
        const SeriesDescription& description() const override { return series; }
        void read(std::size_t, std::span<float> out) override { std::ranges::fill(out, 1.0f); }
        void readHeights(std::size_t, std::span<float> out) override {
            std::ranges::copy(terrain.heights(0.3), out.begin());
        }
        const test::TerrainLattice& terrain;
        SeriesDescription series;
    } source(terrain);
    writeSeries(source, folder_ / "heights.vdb");
    scene_.volumes[0].series = folder_ / "heights.vdb";
    scene_.time = {};
    EXPECT_THROW(SceneExtractor(scene_, {}), Error);
}

TEST(DenseSamples, PeriodicAxesAreClosedAndMissingSamplesStay) {
    Lattice lattice = makeUniformLattice({6, 5, 4}, glm::dvec3(0), glm::dvec3(1));
    lattice.axes[0].period = 6;
    std::vector<float> values = randomFloats({6, 5, 4}, 3);
    removeSamples(values, 10, 4);
    const auto frame = makeKeyFrame(lattice, values);
    DenseSamples cache;
    const auto samples = cache.of({}, *frame, 1);
    EXPECT_EQ(samples->dims, glm::ivec3(7, 5, 4));
    EXPECT_EQ(sampleAxes(lattice)[0].size(), 7u);
    EXPECT_EQ(sampleAxes(lattice)[0].back(), 6);
    std::size_t i = 0;
    for (int z = 0; z < 4; ++z) {
        for (int y = 0; y < 5; ++y) {
            for (int x = 0; x < 7; ++x, ++i) {
                const float wanted = values[sampleAt({6, 5, 4}, {x % 6, y, z})];
                EXPECT_TRUE(samples->values[i] == wanted ||
                            (std::isnan(samples->values[i]) && std::isnan(wanted)));
            }
        }
    }
    EXPECT_EQ(cache.of({}, *frame, 1), samples);
}

TEST(SampleUploads, AFailedUploadKeepsWhatIsShownAndLeaksNothing) {
    gl::HeadlessContext context;
    Renderer renderer(context.context());
    const auto of = [](glm::ivec3 dims) {
        const auto count = static_cast<std::size_t>(dims.x) * dims.y * dims.z;
        return std::make_shared<const VolumeSamples>(makeVolumeSamples(dims, std::vector<float>(count, 1)));
    };
    Scene scene;
    scene.volumes.emplace_back().surfaces.emplace_back();
    scene.layers.emplace();
    SceneSamples good;
    good.first = of({3, 3, 3});
    good.axes.fill({0, 1, 2});
    SampleUploads uploads;
    uploads.replace(good, renderer.volumes());
    // No driver has textures of that length.
    SceneSamples bad = good;
    bad.first = of({3, 3, 3});
    bad.second = of({1 << 17, 2, 2});
    EXPECT_THROW(uploads.replace(bad, renderer.volumes()), Error);
    FrameDescription frame;
    uploads.describe(scene, 0, frame);
    EXPECT_EQ(renderer.volumes().get(frame.layerDraw.value().first).dims, glm::ivec3(3));
    uploads.replace(good, renderer.volumes());
    EXPECT_EQ(renderer.volumes().count(), 1u);
    uploads.replace(std::nullopt, renderer.volumes());
    EXPECT_EQ(renderer.volumes().count(), 0u);
}

TEST(DenseSamples, TooManySamplesTakeACoarserLevel) {
    const auto levelOf = [](int samples) {
        return DenseSamples::levelFor(makeUniformLattice(glm::ivec3(samples), glm::dvec3(0), glm::dvec3(1)));
    };
    EXPECT_EQ(levelOf(256), 0);
    EXPECT_EQ(levelOf(406), 0);  // 406^3 floats are 255.3 MiB
    EXPECT_EQ(levelOf(408), 1);
    EXPECT_EQ(levelOf(1024), 2);
}

}  // namespace
}  // namespace isoglass
