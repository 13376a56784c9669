#include "pipeline/batch.h"

#include "base/error.h"
#include "gl/headless_context.h"
#include "pipeline/render_loop.h"
#include "threads/damage.h"
#include "unit/volume/series_fixture.h"
#include "volume/analytic.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <stdexcept>
#include <thread>

namespace isoglass {
namespace {

constexpr std::size_t kKeyFrames = 4;
constexpr std::int64_t kFrames = 10;

/// A cyclic series of blobs that swing along x, seen through ten frames of a moving camera.
class BatchTest : public testing::Test {
  protected:
    ScratchFolder folder_;
    std::filesystem::path series_ = folder_ / "swing.vdb";
    Scene scene_;

    void SetUp() override {
        const Lattice lattice = makeUnitLattice(25);
        SeriesDescription description = test::describe(lattice, kKeyFrames);
        description.time.period = kKeyFrames;
        std::vector<std::vector<float>> frames;
        for (std::size_t i = 0; i < kKeyFrames; ++i) {
            frames.push_back(sampleField(lattice, blobs, 0.2 * std::sin(2 * M_PI * i / kKeyFrames)));
        }
        test::MemorySource source(description, std::move(frames));
        writeSeries(source, series_);

        Volume volume;
        volume.name = "swing";
        volume.series = series_;
        volume.surfaces = {{.iso = 0.7, .color = {0.9f, 0.3f, 0.1f}, .opacity = 1},
                           {.iso = 0.3, .color = {0.1f, 0.4f, 0.9f}, .opacity = 0.4f}};
        scene_.volumes = {std::move(volume)};
        scene_.time = {.from = 0.0, .to = double{kKeyFrames}, .duration = kFrames / 25.0, .fps = 25};
        scene_.camera.path = {{0, {.eye = {3, 2, 2.5}, .target = {0, 0, 0}}},
                              {0.4, {.eye = {2, 3, 2.5}, .target = {0, 0, 0}}}};
        scene_.image.size = {64, 48};
        scene_.transparency.method = TransparencyMethod::fourPass;
    }

    std::vector<RenderedFrame> render(FrameRange range, SceneExtractor::Options options = {}) {
        SceneExtractor extractor(scene_, options);
        std::vector<RenderedFrame> frames;
        renderFrames(scene_, extractor, range, [&](RenderedFrame frame) {
            frames.push_back(std::move(frame));
            return true;
        });
        return frames;
    }

    /// A budget that holds two key frames and no third.
    std::size_t smallestBudget() const {
        std::size_t largest = 0;
        const SeriesFile file(series_);
        for (const FrameRecord& frame : file.description().frames) {
            largest = std::max<std::size_t>(largest, frame.bytes);
        }
        return 2 * largest;
    }
};

void expectSameImages(const std::vector<RenderedFrame>& a, const std::vector<RenderedFrame>& b) {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
        EXPECT_EQ(a[i].frame, b[i].frame);
        EXPECT_EQ(a[i].image.pixels, b[i].image.pixels) << "frame " << a[i].frame;
    }
}

TEST_F(BatchTest, FramesComeInOrderAndDiffer) {
    const auto frames = render({2, 6});
    ASSERT_EQ(frames.size(), 5u);
    for (std::size_t i = 0; i < frames.size(); ++i) {
        EXPECT_EQ(frames[i].frame, static_cast<std::int64_t>(2 + i));
        EXPECT_EQ(frames[i].image.size, scene_.image.size);
        if (i > 0) {
            EXPECT_NE(frames[i].image.pixels, frames[i - 1].image.pixels);
        }
    }
}

/// The truth without threads: extract, upload, draw.
TEST_F(BatchTest, EachFrameShowsExactlyItsOwnMomentAndCamera) {
    const auto frames = render({0, kFrames - 1});
    ASSERT_EQ(frames.size(), static_cast<std::size_t>(kFrames));
    SceneExtractor extractor(scene_, {});
    gl::HeadlessContext context;
    Renderer renderer(context.context());
    for (const RenderedFrame& frame : frames) {
        const CameraPose camera = scene_.camera.poseAt(static_cast<double>(frame.frame) / scene_.time.fps);
        const double position = static_cast<double>(frame.frame) / kFrames;
        const SceneMeshes meshes = extractor.extract(position, camera, scene_.image.size);
        EXPECT_DOUBLE_EQ(frame.meshes.axisTimes.at(0), position * kKeyFrames);
        FrameDescription description = describeFrame(scene_, {.camera = camera, .size = scene_.image.size});
        description.draws = surfaceDraws(scene_, meshes);
        for (std::size_t i = 0; i < meshes.surfaces.size(); ++i) {
            description.draws[i].mesh = renderer.meshes().upload(*meshes.surfaces[i].mesh);
        }
        renderer.render(description);
        EXPECT_EQ(frame.image.pixels, renderer.readSrgb().pixels) << "frame " << frame.frame;
    }
}

// The camera passes through the volume, so that surfaces are beside, behind and around it.
TEST_F(BatchTest, ImagesDoNotDependOnWhatIsLeftOutBecauseItIsNotSeen) {
    scene_.camera.path = {{0, {.eye = {2, 1.5, 1}, .target = {0.5, -0.5, 0}}},
                          {0.4, {.eye = {0.1, -0.1, 0.2}, .target = {-1, 0.5, 0.3}}}};
    for (const std::optional<double> errorPixels : {std::optional<double>(), std::optional(0.5)}) {
        scene_.quality.errorPixels = errorPixels;
        for (const auto method : {TransparencyMethod::fourPass, TransparencyMethod::exact}) {
            scene_.transparency.method = method;
            const auto seen = render({0, kFrames - 1}, {.seenMargin = 0});
            expectSameImages(render({0, kFrames - 1}), seen);
            std::size_t leftOut = 0;
            for (const RenderedFrame& frame : seen)
                for (const ExtractedSurface& surface : frame.meshes.surfaces)
                    leftOut += surface.stats.leftOut;
            EXPECT_GT(leftOut, 5u);
        }
    }
}

TEST_F(BatchTest, FrameOfASequenceEqualsTheSameFrameAlone) {
    const auto frames = render({0, kFrames - 1});
    for (const std::int64_t k : {std::int64_t{0}, std::int64_t{3}, kFrames - 1}) {
        const auto alone = render({k, k});
        ASSERT_EQ(alone.size(), 1u);
        EXPECT_EQ(alone[0].image.pixels, frames[static_cast<std::size_t>(k)].image.pixels) << "frame " << k;
    }
}

TEST_F(BatchTest, ImagesDoNotDependOnThreadsMemoryOrTheRun) {
    const auto one = render({0, kFrames - 1}, {.threads = 1});
    expectSameImages(one, render({0, kFrames - 1}, {.threads = 2}));
    expectSameImages(one, render({0, kFrames - 1}, {.threads = 1}));
    expectSameImages(one, render({0, kFrames - 1}, {.memoryBytes = smallestBudget()}));
}

TEST_F(BatchTest, EndsEarlyWhenTheSinkSaysSo) {
    SceneExtractor extractor(scene_, {});
    std::vector<std::int64_t> got;
    renderFrames(scene_, extractor, {0, kFrames - 1}, [&](const RenderedFrame& frame) {
        got.push_back(frame.frame);
        return frame.frame < 2;
    });
    EXPECT_EQ(got, (std::vector<std::int64_t>{0, 1, 2}));
}

/// Frame 5 shows key frame 2 alone, frame 6 needs the damaged key frame 3. Whether that was found out
/// already must not change what the caller sees; the pause only makes it likely that it was.
TEST_F(BatchTest, FailureAfterAnEarlyEndIsNotReported) {
    for (int i = 0; i < 5; ++i) {
        SetUp();
        SceneExtractor extractor(scene_, {});
        test::damageEnd(series_);
        EXPECT_NO_THROW(renderFrames(scene_, extractor, {5, kFrames - 1}, [&](const RenderedFrame&) {
            std::this_thread::sleep_for(std::chrono::milliseconds(30));
            return false;
        }));
    }
}

TEST_F(BatchTest, WhatTheSinkThrowsComesOut) {
    for (const std::int64_t last : {std::int64_t{0}, kFrames - 1}) {
        SceneExtractor extractor(scene_, {});
        EXPECT_THROW(
            renderFrames(scene_, extractor, {0, last},
                         [](const RenderedFrame&) -> bool { throw std::runtime_error("disk full"); }),
            std::runtime_error);
    }
}

TEST_F(BatchTest, FailedExtractionIsReportedAfterTheFramesBeforeIt) {
    SceneExtractor extractor(scene_, {});
    test::damageEnd(series_);
    std::vector<std::int64_t> got;
    EXPECT_THROW(renderFrames(scene_, extractor, {3, kFrames - 1},
                              [&](const RenderedFrame& frame) {
                                  got.push_back(frame.frame);
                                  return true;
                              }),
                 Error);
    // Frame 6 is the first that needs the damaged key frame 3.
    EXPECT_EQ(got, (std::vector<std::int64_t>{3, 4, 5}));
}

/// With room for two key frames, and few frames between the sink and the extraction, key frame 3 must be
/// read after the first frame came out.
TEST_F(BatchTest, SeriesDamagedMeanwhileIsReported) {
    scene_.time.duration = 4 * kFrames / 25.0;
    SceneExtractor extractor(scene_, {.memoryBytes = smallestBudget()});
    std::int64_t frames = 0;
    EXPECT_THROW(renderFrames(scene_, extractor, {0, scene_.time.frameCount() - 1},
                              [&](const RenderedFrame&) {
                                  if (frames++ == 0) test::damageEnd(series_);
                                  return true;
                              }),
                 Error);
    // Position 2.1 of 4 is the first to need it.
    EXPECT_EQ(frames, 21);
}

}  // namespace
}  // namespace isoglass
