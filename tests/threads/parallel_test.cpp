#include "basis/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <mutex>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace isoglass {
namespace {

using Chunks = std::multiset<std::pair<std::size_t, std::size_t>>;

constexpr int kThreadCounts[] = {0, 1, 2, 3, 8};

Chunks chunksOf(std::size_t count, std::size_t grain, int threads) {
    Chunks chunks;
    std::mutex mutex;
    parallelFor(count, grain, threads, [&](std::size_t begin, std::size_t end) {
        const std::scoped_lock lock(mutex);
        chunks.emplace(begin, end);
    });
    return chunks;
}

TEST(ParallelFor, VisitsEveryIndexOnce) {
    for (const std::size_t count : {1, 2, 7, 64, 1000}) {
        for (const std::size_t grain : {1, 2, 3, 64, 5000}) {
            for (const int threads : kThreadCounts) {
                std::vector<std::atomic<int>> visits(count);
                parallelFor(count, grain, threads, [&](std::size_t begin, std::size_t end) {
                    for (std::size_t i = begin; i < end; ++i) ++visits.at(i);
                });
                for (std::size_t i = 0; i < count; ++i) {
                    ASSERT_EQ(visits[i], 1)
                        << "index " << i << " of " << count << ", grain " << grain << ", threads " << threads;
                }
            }
        }
    }
}

TEST(ParallelFor, ChunksDoNotDependOnThreads) {
    const Chunks expected = {{0, 3}, {3, 6}, {6, 9}, {9, 10}};
    for (const int threads : kThreadCounts) EXPECT_EQ(chunksOf(10, 3, threads), expected) << threads;
}

TEST(ParallelFor, OneThreadIsTheCallerInOrder) {
    std::vector<std::size_t> begins;
    const std::thread::id caller = std::this_thread::get_id();
    parallelFor(10, 3, 1, [&](std::size_t begin, std::size_t) {
        EXPECT_EQ(std::this_thread::get_id(), caller);
        begins.push_back(begin);
    });
    EXPECT_EQ(begins, (std::vector<std::size_t>{0, 3, 6, 9}));
}

TEST(ParallelFor, NothingToDoCallsNothing) {
    for (const int threads : kThreadCounts) EXPECT_TRUE(chunksOf(0, 4, threads).empty());
}

TEST(ParallelFor, RethrowsWhatABodyThrows) {
    for (const int threads : kThreadCounts) {
        std::atomic<int> running{0};
        try {
            parallelFor(100, 1, threads, [&](std::size_t begin, std::size_t) {
                ++running;
                if (begin == 42) {
                    --running;
                    throw std::runtime_error("index 42");
                }
                --running;
            });
            ADD_FAILURE() << "nothing was thrown with threads " << threads;
        } catch (const std::runtime_error& error) {
            EXPECT_EQ(std::string(error.what()), "index 42");
        }
        EXPECT_EQ(running, 0) << "a body still runs after the call returned, threads " << threads;
    }
}

TEST(ParallelFor, RethrowsOneOfMany) {
    for (const int threads : kThreadCounts) {
        EXPECT_THROW(
            parallelFor(50, 1, threads, [](std::size_t, std::size_t) { throw std::runtime_error("each"); }),
            std::runtime_error);
    }
}

TEST(ParallelFor, MayBeNested) {
    for (const int threads : kThreadCounts) {
        std::vector<std::atomic<int>> visits(20 * 30);
        parallelFor(20, 1, threads, [&](std::size_t row, std::size_t) {
            parallelFor(30, 7, threads, [&](std::size_t begin, std::size_t end) {
                for (std::size_t i = begin; i < end; ++i) ++visits[row * 30 + i];
            });
        });
        for (const auto& count : visits) ASSERT_EQ(count, 1) << "threads " << threads;
    }
}

}  // namespace
}  // namespace isoglass
