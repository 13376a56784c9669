#include "basis/mailbox.h"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <memory>
#include <optional>
#include <thread>
#include <vector>

namespace isoglass {
namespace {

TEST(Mailbox, NewestWins) {
    Mailbox<int> box;
    box.post(1);
    box.post(2);
    box.post(3);
    EXPECT_EQ(box.tryTake(), 3);
    EXPECT_EQ(box.tryTake(), std::nullopt);
}

TEST(Mailbox, TryTakeOfAnEmptyBoxReturnsAtOnce) {
    Mailbox<int> box;
    EXPECT_EQ(box.tryTake(), std::nullopt);
}

TEST(Mailbox, DroppedValueIsFreed) {
    Mailbox<std::shared_ptr<int>> box;
    const auto value = std::make_shared<int>(1);
    box.post(value);
    box.post(nullptr);
    EXPECT_EQ(value.use_count(), 1);
}

TEST(Mailbox, TakeWaitsForAPost) {
    Mailbox<int> box;
    std::atomic<int> got{0};
    std::jthread taker([&](std::stop_token stop) { got = box.take(stop).value_or(-1); });
    box.post(7);
    taker.join();
    EXPECT_EQ(got, 7);
}

TEST(Mailbox, TakeReturnsNothingOnStop) {
    Mailbox<int> box;
    std::optional<int> got = 1;
    std::jthread taker([&](std::stop_token stop) { got = box.take(stop); });
    taker.request_stop();
    taker.join();
    EXPECT_EQ(got, std::nullopt);
}

TEST(Mailbox, AfterStopAWaitingValueIsLeft) {
    Mailbox<int> box;
    std::stop_source source;
    source.request_stop();
    box.post(5);
    EXPECT_EQ(box.take(source.get_token()), std::nullopt);
    EXPECT_EQ(box.tryTake(), 5);
}

/// Each producer posts rising numbers of its own. The consumer may miss some, but never sees one
/// producer's numbers fall, and what lies in the box at the end is somebody's last.
TEST(Mailbox, ManyProducersNeverLoseTheLastValue) {
    struct Value {
        std::size_t producer;
        int number;
    };
    constexpr int kPosts = 2000;
    constexpr std::size_t kProducers = 4;
    for (int round = 0; round < 10; ++round) {
        Mailbox<Value> box;
        std::array<int, kProducers> newest{};
        std::optional<Value> last;
        std::jthread consumer([&](std::stop_token stop) {
            while (const auto value = box.take(stop)) {
                EXPECT_GT(value->number, newest.at(value->producer));
                newest.at(value->producer) = value->number;
                last = value;
            }
        });
        {
            std::vector<std::jthread> producers;
            for (std::size_t p = 0; p < kProducers; ++p) {
                producers.emplace_back([&box, p] {
                    for (int i = 1; i <= kPosts; ++i) box.post({p, i});
                });
            }
        }
        consumer.request_stop();
        consumer.join();
        if (const auto rest = box.tryTake()) last = rest;
        ASSERT_TRUE(last.has_value());
        EXPECT_EQ(last->number, kPosts);
    }
}

}  // namespace
}  // namespace isoglass
