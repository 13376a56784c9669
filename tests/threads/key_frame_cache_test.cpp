#include "pipeline/key_frame_cache.h"

#include "base/error.h"
#include "threads/damage.h"
#include "threads/eventually.h"
#include "unit/volume/series_fixture.h"
#include "volume/detail_error.h"
#include "volume/pyramid.h"

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <barrier>
#include <functional>
#include <random>
#include <thread>

namespace isoglass {
namespace {

using test::eventually;
using test::firstDifference;
using test::MemorySource;

constexpr std::size_t kFrames = 12;
const Lattice kLattice = makeUniformLattice({24, 24, 16}, glm::dvec3(0), glm::dvec3(1));

/// Random samples, but for the first i bricks of key frame i, which are constant: all differ in size.
std::vector<std::vector<float>> randomFrames(std::uint32_t seed) {
    const glm::ivec3 dims = kLattice.dims();
    const glm::ivec3 bricks = dims / kBrickSize;
    std::vector<std::vector<float>> frames;
    for (std::uint32_t i = 0; i < kFrames; ++i) {
        frames.push_back(randomFloats(dims, seed + i));
        for (int z = 0; z < dims.z; ++z) {
            for (int y = 0; y < dims.y; ++y) {
                for (int x = 0; x < dims.x; ++x) {
                    const glm::ivec3 brick = glm::ivec3(x, y, z) / kBrickSize;
                    if (sampleAt(bricks, brick) < i) frames.back()[sampleAt(dims, {x, y, z})] = 0.5f;
                }
            }
        }
    }
    return frames;
}

std::string messageOf(const std::function<void()>& act) {
    try {
        act();
    } catch (const Error& error) {
        return error.what();
    }
    return "no error";
}

/// Two series of twelve key frames in files.
class KeyFrameCacheTest : public testing::Test {
  protected:
    /// OpenVDB works in the calling thread: Debian's TBB is not built for the thread sanitizer, which would
    /// see races where TBB's threads meet.
    const tbb::global_control noTbbThreads_{tbb::global_control::max_allowed_parallelism, 1};
    ScratchFolder folder_;
    std::vector<std::vector<std::vector<float>>> samples_;
    std::vector<std::filesystem::path> paths_;
    std::vector<std::shared_ptr<const SeriesFile>> files_;

    void SetUp() override {
        for (const std::uint32_t seed : {100u, 200u}) {
            samples_.push_back(randomFrames(seed));
            paths_.push_back(folder_ / ("series" + std::to_string(seed) + ".vdb"));
            MemorySource source(test::describe(kLattice, kFrames), samples_.back());
            writeSeries(source, paths_.back());
            files_.push_back(std::make_shared<SeriesFile>(paths_.back()));
        }
    }

    std::size_t bytesOf(FrameKey key) const {
        return files_[key.series]->description().frames[key.frame].bytes;
    }

    std::size_t largestFrame() const {
        std::size_t largest = 0;
        for (const FrameKey key : allKeys()) largest = std::max(largest, bytesOf(key));
        return largest;
    }

    std::vector<FrameKey> allKeys() const {
        std::vector<FrameKey> keys;
        for (std::size_t series = 0; series < files_.size(); ++series) {
            for (std::size_t frame = 0; frame < kFrames; ++frame) keys.push_back({series, frame});
        }
        return keys;
    }

    std::size_t bytesOfHeld(const KeyFrameCache& cache) const {
        std::size_t sum = 0;
        for (const FrameKey key : allKeys()) sum += cache.holds(key) ? bytesOf(key) : 0;
        return sum;
    }

    void expectRight(const KeyFrame& frame, FrameKey key) const {
        EXPECT_EQ(firstDifference(frame, samples_[key.series][key.frame]), -1)
            << "series " << key.series << ", key frame " << key.frame;
    }

    /// Changes samples of the last key frame: they end the file.
    void damageLastFrame(std::size_t series) { test::damageEnd(paths_[series]); }
};

TEST_F(KeyFrameCacheTest, CountsLevelsAndWhatTheyLackWithTheMostTheyMayTake) {
    std::size_t counted = bytesOf({0, 5});
    for (const auto kept : {KeyFrameCache::Frames::withLevels, KeyFrameCache::Frames::withErrors}) {
        KeyFrameCache cache(files_, std::size_t{1} << 30, kept);
        const auto frame = cache.get({0, 5});
        const bool errors = kept == KeyFrameCache::Frames::withErrors;
        EXPECT_GE(cache.bytes(),
                  frame->bytes() + frame->pyramid().bytes() + (errors ? frame->detailError().bytes() : 0));
        EXPECT_GT(cache.bytes(), counted);
        counted = cache.bytes();
    }
}

TEST_F(KeyFrameCacheTest, GivesEveryKeyFrameAndCountsItsMemory) {
    KeyFrameCache cache(files_, 4 * largestFrame());
    for (const FrameKey key : allKeys()) {
        const auto frame = cache.get(key);
        expectRight(*frame, key);
        EXPECT_EQ(frame->bytes(), bytesOf(key));
        EXPECT_TRUE(cache.holds(key));
    }
    EXPECT_EQ(cache.bytes(), bytesOfHeld(cache));
}

/// One thread holds up to two frames, another one at a time, a third watches: the least budget that
/// serves them is three frames, and it leaves nothing over for reading ahead to hide in.
TEST_F(KeyFrameCacheTest, HardBudgetHoldsWhileTwoThreadsReadAtRandom) {
    const std::size_t budget = 3 * largestFrame();
    KeyFrameCache cache(files_, budget);
    const std::vector<FrameKey> keys = allKeys();
    {
        std::jthread watcher([&](std::stop_token stop) {
            while (!stop.stop_requested()) ASSERT_LE(cache.bytes(), budget);
        });
        const auto pick = [&keys](std::mt19937& random) { return keys[random() % keys.size()]; };
        std::jthread holder([&] {
            std::mt19937 random(1);
            for (int i = 0; i < 300; ++i) {
                const FrameKey a = pick(random), b = pick(random);
                cache.want({a, b, pick(random), pick(random)});
                const auto frameA = cache.get(a);
                const auto frameB = cache.get(b);
                expectRight(*frameA, a);
                expectRight(*frameB, b);
            }
        });
        std::mt19937 random(2);
        for (int i = 0; i < 300; ++i) {
            const FrameKey key = pick(random);
            if (i % 3 == 0) cache.want({pick(random), pick(random), pick(random)});
            expectRight(*cache.get(key), key);
        }
        holder.join();
    }
    cache.want({});
    EXPECT_TRUE(eventually([&] { return cache.bytes() == bytesOfHeld(cache); }))
        << cache.bytes() << " bytes are counted, " << bytesOfHeld(cache) << " are held";
}

/// Two threads wait for room that a frame being read ahead takes. If both read, the second copy would stay
/// in the count for ever.
TEST_F(KeyFrameCacheTest, FrameAskedForTwiceAtOnceIsReadOnce) {
    KeyFrameCache cache(files_, 2 * largestFrame());
    // With this in use there is room for one frame more.
    const auto held = cache.get({1, 0});
    const std::size_t bytesWhileReading = bytesOf({1, 0}) + bytesOf({1, 2});
    std::barrier together(2);
    std::array<std::shared_ptr<const KeyFrame>, 2> got;
    std::atomic<bool> lostCount{false};
    const auto ask = [&](std::size_t thread) {
        for (std::size_t round = 0; round < 200; ++round) {
            if (thread == 0) cache.want({{1, 2}});
            // Whoever is late finds the frame read: the race is lost, the claim still holds.
            const auto raceIsOn = [&] {
                return cache.bytes() == bytesWhileReading || cache.holds({0, round % 2}) || lostCount;
            };
            if (!eventually(raceIsOn)) lostCount = true;
            EXPECT_NO_THROW(got.at(thread) = cache.get({0, round % 2})) << "round " << round;
            together.arrive_and_wait();
            if (thread == 0) {
                EXPECT_EQ(got[0], got[1]) << "round " << round;
                cache.want({});
            }
            together.arrive_and_wait();
            got.at(thread).reset();
            together.arrive_and_wait();
        }
    };
    {
        std::jthread other([&] { ask(1); });
        ask(0);
    }
    EXPECT_FALSE(lostCount);
    EXPECT_TRUE(eventually([&] { return cache.bytes() == bytesOfHeld(cache); }))
        << cache.bytes() << " bytes are counted, " << bytesOfHeld(cache) << " are held";
}

/// `get` makes reading ahead step back; it must say when it is done, also when it only had to wait for a
/// frame that was being read.
TEST_F(KeyFrameCacheTest, ReadingAheadGoesOnAfterGet) {
    for (int round = 0; round < 100; ++round) {
        KeyFrameCache cache(files_, 24 * largestFrame());
        cache.want({{0, 0}, {0, 1}, {0, 2}});
        ASSERT_TRUE(eventually([&] { return cache.bytes() > 0; }));
        cache.get({0, 0});
        ASSERT_TRUE(eventually([&] {
            return cache.holds({0, 1}) && cache.holds({0, 2});
        })) << "round "
            << round;
    }
}

TEST_F(KeyFrameCacheTest, StoredLevelsAreFramesOfTheirOwn) {
    KeyFrameCache cache(files_, std::size_t{1} << 30, KeyFrameCache::Frames::withErrors);
    const auto level = cache.get({0, 5, 1});
    EXPECT_EQ(level->dims(), coarseLattice(kLattice, 1).dims());
    EXPECT_EQ(cache.bytes(), level->bytes());
    EXPECT_EQ(level->bytes(), files_[0]->description().frames[5].levels[0].bytes);
    EXPECT_TRUE(cache.holds({0, 5, 1}));
    EXPECT_FALSE(cache.holds({0, 5}));
    EXPECT_EQ(cache.get({0, 5, 1}), level);
}

TEST_F(KeyFrameCacheTest, ExpectsToWaitForWhatIsNotThereByItsSize) {
    KeyFrameCache cache(files_, 24 * largestFrame());
    const FrameKey small{0, kFrames - 1}, large{0, 0};
    EXPECT_GT(cache.expectedSeconds(small), 0);
    EXPECT_NEAR(cache.expectedSeconds(large) / cache.expectedSeconds(small),
                static_cast<double>(bytesOf(large)) / static_cast<double>(bytesOf(small)), 1e-12);
    EXPECT_LT(cache.expectedSeconds({0, 0, 1}), cache.expectedSeconds(large));
    const double before = cache.expectedSeconds(large);
    cache.get(small);
    EXPECT_EQ(cache.expectedSeconds(small), 0);
    EXPECT_NE(cache.expectedSeconds(large), before) << "nothing was learnt from a read";
}

TEST_F(KeyFrameCacheTest, SaysWhenAFrameWasReadAhead) {
    std::atomic<int> calls{0};
    KeyFrameCache cache(files_, 24 * largestFrame(), KeyFrameCache::Frames::plain, [&] { ++calls; });
    cache.get({0, 1});
    EXPECT_EQ(cache.arrivals(), 0u) << "whoever asks for a frame knows when it is there";
    cache.want({{0, 1}, {0, 3}, {1, 7}});
    EXPECT_TRUE(eventually([&] { return calls == 2; }));
    EXPECT_EQ(cache.arrivals(), 2u);
}

TEST_F(KeyFrameCacheTest, ReadsAheadWhatIsWanted) {
    KeyFrameCache cache(files_, 24 * largestFrame());
    EXPECT_EQ(cache.bytes(), 0u);
    cache.want({{0, 3}, {1, 7}});
    EXPECT_TRUE(eventually([&] { return cache.holds({0, 3}) && cache.holds({1, 7}); }));
    EXPECT_EQ(cache.bytes(), bytesOf({0, 3}) + bytesOf({1, 7})) << "more was read than was wanted";
    expectRight(*cache.get({1, 7}), {1, 7});
}

TEST_F(KeyFrameCacheTest, ReadsAheadInOrderAsFarAsTheBudgetReaches) {
    KeyFrameCache cache(files_, 3 * largestFrame());
    cache.want({{1, 0}});
    ASSERT_TRUE(eventually([&] { return cache.holds({1, 0}); }));
    cache.want({{0, 0}, {0, 1}, {0, 2}, {0, 3}});
    EXPECT_TRUE(eventually([&] {
        return cache.holds({0, 0}) && cache.holds({0, 1}) && cache.holds({0, 2});
    }));
    // Frames shrink with their number: the first three fill the budget but for less than the fourth.
    ASSERT_GT(bytesOf({0, 0}) + bytesOf({0, 1}) + bytesOf({0, 2}) + bytesOf({0, 3}), cache.budgetBytes());
    EXPECT_FALSE(cache.holds({0, 3}));
    EXPECT_FALSE(cache.holds({1, 0})) << "a frame that nobody wants takes the room of one that is wanted";
}

TEST_F(KeyFrameCacheTest, FramesInUseAreNeverDropped) {
    KeyFrameCache cache(files_, 2 * largestFrame());
    const auto held = cache.get({0, 5});
    cache.want(allKeys());
    for (const FrameKey key : allKeys()) {
        expectRight(*cache.get(key), key);
        ASSERT_TRUE(cache.holds({0, 5}));
    }
    EXPECT_EQ(cache.get({0, 5}), held);
}

TEST_F(KeyFrameCacheTest, BudgetUsedUpByFramesInUseIsAnErrorNotADeadlock) {
    KeyFrameCache cache(files_, 2 * largestFrame());
    const auto a = cache.get({0, 0});
    const auto b = cache.get({1, 0});
    const std::string message = messageOf([&] { cache.get({0, 1}); });
    EXPECT_NE(message.find("frames in use"), std::string::npos) << message;
    EXPECT_NE(message.find(paths_[0].string()), std::string::npos) << message;
    EXPECT_EQ(cache.bytes(), bytesOf({0, 0}) + bytesOf({1, 0}));
}

TEST_F(KeyFrameCacheTest, BudgetBelowTwoKeyFramesIsAnErrorThatNamesTheSizeNeeded) {
    const std::size_t needed = 2 * largestFrame();
    EXPECT_NO_THROW(KeyFrameCache(files_, needed));
    const std::string message = messageOf([&] { KeyFrameCache(files_, needed - 1); });
    const std::string hint = "--memory " + std::to_string((needed + 999) / 1000) + "kB";
    EXPECT_NE(message.find(hint), std::string::npos) << message << " lacks " << hint;
    EXPECT_NE(message.find(paths_[0].string()), std::string::npos) << message;
}

TEST_F(KeyFrameCacheTest, DamagedKeyFrameIsReportedByGet) {
    KeyFrameCache cache(files_, 4 * largestFrame());
    damageLastFrame(0);
    const std::string message = messageOf([&] { cache.get({0, kFrames - 1}); });
    EXPECT_NE(message.find(paths_[0].string()), std::string::npos) << message;
    EXPECT_NE(message.find("key frame " + std::to_string(kFrames - 1)), std::string::npos) << message;
    EXPECT_EQ(cache.bytes(), 0u);
    EXPECT_FALSE(cache.holds({0, kFrames - 1}));
}

TEST_F(KeyFrameCacheTest, FailedReadAheadIsLeftForGetAndDoesNotEndTheThread) {
    KeyFrameCache cache(files_, 4 * largestFrame());
    damageLastFrame(0);
    cache.want({{0, kFrames - 1}, {1, 2}});
    EXPECT_TRUE(eventually([&] { return cache.holds({1, 2}); }));
    cache.want({{1, 3}});
    EXPECT_TRUE(eventually([&] { return cache.holds({1, 3}); }));
    EXPECT_THROW(cache.get({0, kFrames - 1}), Error);
}

TEST_F(KeyFrameCacheTest, DestructionWhileReadingAheadEnds) {
    for (int i = 0; i < 20; ++i) {
        KeyFrameCache cache(files_, 24 * largestFrame());
        cache.want(allKeys());
    }
}

}  // namespace
}  // namespace isoglass
