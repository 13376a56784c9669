// Playback from a disk that brings key frames late or not at all. No test measures time: what the disk
// brings, and when, is in the hands of the test.

#include "base/error.h"
#include "pipeline/scene_extractor.h"
#include "threads/eventually.h"
#include "unit/volume/series_fixture.h"
#include "volume/pyramid.h"
#include "volume/series_set.h"

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <memory>
#include <mutex>
#include <numeric>
#include <random>
#include <thread>
#include <utility>
#include <vector>

namespace isoglass {
namespace {

using test::eventually;
using test::MemorySource;

/// 64 cells along x: level 1 is the coarsest that may be shown.
constexpr glm::ivec3 kDims(65, 9, 9);
constexpr float kIso = 0.5f;

/// A disk that brings key frames only while its gate is open, and remembers what was asked of it. Levels come
/// at once.
class Disk {
  public:
    explicit Disk(std::shared_ptr<const SeriesFile> file) : file_(std::move(file)) {}
    ~Disk() { open(); }

    void close() {
        const std::scoped_lock lock(mutex_);
        open_ = false;
    }
    void open() {
        const std::scoped_lock lock(mutex_);
        open_ = true;
        changed_.notify_all();
    }
    /// From now on key frames cannot be read.
    void breakDown() { broken_ = true; }
    void repair() { broken_ = false; }
    /// Frames whose samples were asked for, in that order.
    std::vector<std::size_t> asked() const {
        const std::scoped_lock lock(mutex_);
        return asked_;
    }

    std::shared_ptr<const SeriesFile> series() {
        return std::make_shared<SeriesFile>(
            file_->path(), file_->description(), [this](std::size_t frame, int level) {
                if (level == 0) {
                    std::unique_lock lock(mutex_);
                    asked_.push_back(frame);
                    changed_.wait(lock, [this] { return open_; });
                    if (broken_) throw Error("the disk is broken", file_->path().string());
                }
                return file_->readLevel(frame, level);
            });
    }
    const SeriesFile& file() const { return *file_; }

  private:
    const std::shared_ptr<const SeriesFile> file_;
    mutable std::mutex mutex_;
    std::condition_variable changed_;
    bool open_ = true;
    std::atomic<bool> broken_{false};
    std::vector<std::size_t> asked_;
};

/// A series of noise at times 0, 1, 2, ... on such a disk, in a scene that plays all of it.
class StreamingTest : public testing::Test {
  protected:
    /// Debian's TBB is not built for the thread sanitizer; OpenVDB works in the calling thread.
    const tbb::global_control noTbbThreads_{tbb::global_control::max_allowed_parallelism, 1};
    ScratchFolder folder_;
    std::unique_ptr<Disk> disk_;
    Scene scene_;
    std::unique_ptr<SceneExtractor> extractor_;

    /// A closed disk would hold the extractor's thread for ever.
    void TearDown() override {
        disk_->open();
        extractor_.reset();
    }

    void makeSeries(std::size_t frames, const SparsityOptions& options = {},
                    std::optional<double> period = {}) {
        const Lattice lattice = makeUniformLattice(kDims, glm::dvec3(0), glm::dvec3(1));
        std::vector<std::vector<float>> samples;
        for (std::uint32_t i = 0; i < frames; ++i) samples.push_back(randomFloats(kDims, i));
        SeriesDescription series = test::describe(lattice, frames);
        series.time.period = period;
        MemorySource source(series, std::move(samples));
        writeSeries(source, folder_ / "series.vdb", options);
        disk_ = std::make_unique<Disk>(std::make_shared<SeriesFile>(folder_ / "series.vdb"));
        Volume volume;
        volume.name = "noise";
        volume.series = folder_ / "series.vdb";
        volume.surfaces = {{.iso = kIso, .opacity = 1}};
        scene_.volumes = {std::move(volume)};
        // Ten displayed frames from key frame to key frame.
        const auto intervals = static_cast<double>(frames - 1);
        scene_.time = {.from = 0.0, .to = intervals, .duration = 10 * intervals / 25, .fps = 25};
    }

    SceneExtractor::Options options(std::optional<double> patience) {
        return {.threads = 1, .patienceSeconds = patience, .open = [this](const Volume&) {
                    return disk_->series();
                }};
    }

    void start(SceneExtractor::Options options) {
        extractor_ = std::make_unique<SceneExtractor>(scene_, std::move(options));
    }

    SceneMeshes extract(double position, Course course = {}) {
        return extractor_->extract(position, {.eye = {100, 40, 30}, .target = {32, 4, 4}}, {64, 48}, course);
    }

    const KeyFrameCache& cache() const { return extractor_->cache(); }

    /// Straight from the file.
    SurfaceMesh wanted(double position, int level) const {
        const SeriesDescription& series = disk_->file().description();
        const TimeSample sample =
            locate(series.time, position * static_cast<double>(series.time.times.size() - 1));
        TimedField field;
        field.a = disk_->file().readLevel(sample.frameA, level);
        if (sample.fraction > 0) field.b = disk_->file().readLevel(sample.frameB, level);
        field.fraction = static_cast<float>(sample.fraction);
        return extractSurface(coarseLattice(series.lattice, level), field, {.iso = kIso, .threads = 1}).mesh;
    }

    void expectMesh(const SceneMeshes& meshes, double position) const {
        ASSERT_EQ(meshes.surfaces.size(), 1u);
        const SurfaceMesh& found = *meshes.surfaces[0].mesh;
        const SurfaceMesh right = wanted(position, meshes.substitute());
        EXPECT_GT(found.triangleCount(), 0u);
        EXPECT_EQ(found.triangles, right.triangles) << position;
        EXPECT_EQ(found.positions, right.positions) << position;
    }
};

TEST_F(StreamingTest, StoredLevelIsShownUntilTheKeyFramesAreThere) {
    makeSeries(4);
    disk_->close();
    start(options(0));
    const SceneMeshes first = extract(0.5);
    EXPECT_EQ(first.substitutes, std::vector<int>{1});
    expectMesh(first, 0.5);
    EXPECT_EQ(cache().arrivals(), 0u);
    disk_->open();
    ASSERT_TRUE(eventually([&] { return cache().arrivals() >= 2; }));
    const SceneMeshes second = extract(0.5);
    EXPECT_EQ(second.substitutes, std::vector<int>{0});
    expectMesh(second, 0.5);
}

TEST_F(StreamingTest, OneKeyFrameOfTwoIsNotMixedWithALevel) {
    makeSeries(4);
    std::atomic<int> arrivals{0};
    SceneExtractor::Options closesAfterOne = options(0);
    closesAfterOne.arrived = [&] {
        if (++arrivals == 1) disk_->close();
    };
    start(closesAfterOne);
    extract(0.5);
    ASSERT_TRUE(eventually([&] { return disk_->asked().size() == 2; }));
    ASSERT_TRUE(cache().holds({0, 1}));
    ASSERT_FALSE(cache().holds({0, 2}));
    const SceneMeshes meshes = extract(0.5);
    EXPECT_EQ(meshes.substitute(), 1);
    expectMesh(meshes, 0.5);
    // The first alone is the moment at 1.
    EXPECT_EQ(extract(1.0 / 3).substitute(), 0);
    disk_->open();
    extractor_.reset();
}

/// The level must not stand there for ever.
TEST_F(StreamingTest, KeyFrameThatCannotBeReadIsReported) {
    makeSeries(4);
    disk_->close();
    disk_->breakDown();
    start(options(0));
    EXPECT_EQ(extract(0.5).substitute(), 1);
    disk_->open();
    ASSERT_TRUE(eventually([&] { return cache().arrivals() >= 1; }));
    EXPECT_THROW(extract(1.0 / 3), Error);
}

TEST_F(StreamingTest, BatchWaitsForTheKeyFrames) {
    makeSeries(4);
    disk_->close();
    start(options(std::nullopt));
    std::atomic<bool> done{false};
    SceneMeshes meshes;
    std::jthread other([&] {
        meshes = extract(0.5);
        done = true;
    });
    EXPECT_TRUE(eventually([&] { return !disk_->asked().empty(); }));
    EXPECT_FALSE(done);
    disk_->open();
    other.join();
    EXPECT_EQ(meshes.substitute(), 0);
    expectMesh(meshes, 0.5);
}

TEST_F(StreamingTest, WithoutStoredLevelsTheKeyFramesAreWaitedFor) {
    makeSeries(4, {.levels = false});
    start(options(0));
    const SceneMeshes meshes = extract(0.5);
    EXPECT_EQ(meshes.substitute(), 0);
    expectMesh(meshes, 0.5);
}

/// A level would take the room of a key frame, which would be read again, and so on.
TEST_F(StreamingTest, WhereLevelsDoNotFitBesideTheKeyFramesThoseAreWaitedFor) {
    makeSeries(4);
    const std::size_t largest = disk_->file().description().frames[1].bytes;
    SceneExtractor::Options tight = options(0);
    tight.memoryBytes = 2 * largest;
    start(tight);
    for (int i = 0; i < 20; ++i) {
        const SceneMeshes meshes = extract(i % 2 == 0 ? 0.5 : 0.9);
        EXPECT_EQ(meshes.substitute(), 0);
        expectMesh(meshes, i % 2 == 0 ? 0.5 : 0.9);
    }
}

/// It is no longer one that `get` alone can bring.
TEST_F(StreamingTest, KeyFrameThatFailedOnceIsReadAheadAgain) {
    makeSeries(8);
    disk_->breakDown();
    disk_->close();  // so that reading fails after the level was taken, not before
    std::size_t most = 0;
    for (const FrameRecord& frame : disk_->file().description().frames)
        most = std::max<std::size_t>(most, 2 * (frame.bytes + frame.levels[0].bytes));
    SceneExtractor::Options tight = options(0);
    tight.memoryBytes = most;
    start(tight);
    extract(3.0 / 7);
    disk_->open();
    ASSERT_TRUE(eventually([&] { return cache().arrivals() >= 1; }));
    EXPECT_THROW(extract(3.0 / 7), Error);
    EXPECT_EQ(cache().expectedSeconds({0, 3}), 0);
    disk_->repair();
    EXPECT_EQ(extract(3.0 / 7).substitute(), 0);
    ASSERT_TRUE(eventually([&] {
        extract(5.5 / 7);
        return !cache().holds({0, 3});
    }));
    EXPECT_GT(cache().expectedSeconds({0, 3}), 0);
}

TEST_F(StreamingTest, WhatIsReadInTimeIsWaitedFor) {
    makeSeries(4);
    start(options(1e9));
    EXPECT_EQ(extract(0.5).substitute(), 0);
}

class StreamingOrderTest : public StreamingTest {
  protected:
    /// The frames that are read ahead, in that order. With patience 0 nobody else reads key frames.
    std::vector<std::size_t> order(double position, Course course, std::size_t count) {
        start(options(0));
        extract(position, course);
        EXPECT_TRUE(eventually([&] { return cache().arrivals() >= count; }));
        return disk_->asked();
    }
};

/// More key frames than are looked ahead: each of the next ones, none left out.
TEST_F(StreamingOrderTest, NextKeyFramesComeFirst) {
    makeSeries(200);
    std::vector<std::size_t> next(65);
    std::iota(next.begin(), next.end(), 0);
    EXPECT_EQ(order(0, {}, 65), next);
}

/// Five displayed frames, 9.4 key intervals apart: of the key frames those on either side of each are read,
/// after the next one, to which a step goes.
TEST_F(StreamingOrderTest, KeyFramesThatAreNotDisplayedAreLeftOut) {
    makeSeries(48);
    scene_.time.duration = 5 / scene_.time.fps;
    EXPECT_EQ(order(0, {}, 11), (std::vector<std::size_t>{0, 1, 9, 10, 18, 19, 28, 29, 37, 38, 47}));
}

TEST_F(StreamingOrderTest, BackwardsThePreviousOnesComeFirst) {
    makeSeries(8);
    EXPECT_EQ(order(0.5, {.forwards = false}, 5), (std::vector<std::size_t>{3, 4, 2, 1, 0}));
}

TEST_F(StreamingOrderTest, ALoopGoesOnAtTheOtherEnd) {
    makeSeries(8);
    EXPECT_EQ(order(0.5, {.forwards = true, .loops = true}, 8),
              (std::vector<std::size_t>{3, 4, 5, 6, 7, 0, 1, 2}));
}

TEST_F(StreamingOrderTest, ABackwardLoopGoesOnAtTheEnd) {
    makeSeries(8);
    EXPECT_EQ(order(0.5, {.forwards = false, .loops = true}, 8),
              (std::vector<std::size_t>{3, 4, 2, 1, 0, 7, 6, 5}));
}

TEST_F(StreamingOrderTest, OrderIsThatOfTheTimelineWhereTimeRunsBackwards) {
    makeSeries(8);
    scene_.time.from = 7.0;
    scene_.time.to = 0.0;
    EXPECT_EQ(order(0.5, {}, 5), (std::vector<std::size_t>{3, 4, 2, 1, 0}));
}

TEST_F(StreamingOrderTest, TheNextTurnOfAPeriodIsAhead) {
    makeSeries(4, {}, 4.0);
    scene_.time.from = 2.5;
    scene_.time.to = 7.5;
    // From the last interval through the one that closes the circle.
    EXPECT_EQ(order(0, {}, 4), (std::vector<std::size_t>{2, 3, 0, 1}));
}

/// Plays forwards, backwards and by leaps through a file ten times the budget while the disk opens and
/// closes: whatever is shown is right, and the budget holds.
TEST_F(StreamingTest, AFileLargerThanTheBudgetPlays) {
    constexpr std::size_t kFrames = 40;
    makeSeries(kFrames);
    SceneExtractor::Options small = options(0);
    std::uint64_t largest = 0;
    for (const FrameRecord& frame : disk_->file().description().frames)
        largest = std::max(largest, frame.bytes);
    small.memoryBytes = kFrames / 10 * largest;
    start(small);
    std::jthread watcher([&](std::stop_token stop) {
        while (!stop.stop_requested()) ASSERT_LE(cache().bytes(), small.memoryBytes);
    });
    std::mt19937 random(3);
    int substitutes = 0;
    for (int i = 0; i < 240; ++i) {
        const double run = i % 80 / 80.0;
        const double position = i < 80 ? run : i < 160 ? 1 - run : static_cast<double>(random() % 1000) / 1e3;
        const Course course{.forwards = i < 80, .loops = true};
        if (i % 12 == 0) disk_->close();
        if (i % 12 == 6) disk_->open();
        const SceneMeshes meshes = extract(position, course);
        expectMesh(meshes, position);
        substitutes += meshes.substitute();
        if (i % 12 != 11) continue;
        // Once the disk has caught up the moment is whole.
        SceneMeshes whole;
        EXPECT_TRUE(eventually([&] { return (whole = extract(position, course)).substitute() == 0; }));
        expectMesh(whole, position);
    }
    EXPECT_GT(substitutes, 0);
}

}  // namespace
}  // namespace isoglass
