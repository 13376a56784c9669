#include "basis/bounded_queue.h"

#include "threads/eventually.h"

#include <gtest/gtest.h>

#include <atomic>
#include <optional>
#include <thread>

namespace isoglass {
namespace {

TEST(BoundedQueue, KeepsTheOrderFromThreadToThread) {
    constexpr int kValues = 5000;
    BoundedQueue<int> queue(3);
    std::jthread producer([&] {
        for (int i = 0; i < kValues; ++i) EXPECT_TRUE(queue.push(i));
        queue.close();
    });
    for (int i = 0; i < kValues; ++i) ASSERT_EQ(queue.pop(), i);
    EXPECT_EQ(queue.pop(), std::nullopt);
}

TEST(BoundedQueue, NeverHoldsMoreThanItsCapacity) {
    constexpr int kCapacity = 2;
    constexpr int kValues = 3000;
    BoundedQueue<int> queue(kCapacity);
    std::atomic<int> pushed{0};
    std::jthread producer([&] {
        for (int i = 0; i < kValues; ++i) {
            queue.push(i);
            ++pushed;
        }
    });
    ASSERT_TRUE(test::eventually([&] { return pushed == kCapacity; }));
    for (int popped = 0; popped < kValues; ++popped) {
        // What was pushed and not yet popped lies in the queue.
        EXPECT_LE(pushed - popped, kCapacity);
        ASSERT_EQ(queue.pop(), popped);
    }
}

TEST(BoundedQueue, CloseWakesAWaitingPop) {
    BoundedQueue<int> queue(1);
    std::optional<int> got = 1;
    std::jthread consumer([&] { got = queue.pop(); });
    queue.close();
    consumer.join();
    EXPECT_EQ(got, std::nullopt);
}

TEST(BoundedQueue, CloseWakesAWaitingPush) {
    BoundedQueue<int> queue(1);
    ASSERT_TRUE(queue.push(1));
    bool accepted = true;
    std::jthread producer([&] { accepted = queue.push(2); });
    queue.close();
    producer.join();
    EXPECT_FALSE(accepted);
}

TEST(BoundedQueue, WhatLiesInAClosedQueueCanBePopped) {
    BoundedQueue<int> queue(2);
    ASSERT_TRUE(queue.push(1));
    queue.close();
    queue.close();
    EXPECT_FALSE(queue.push(2));
    EXPECT_EQ(queue.pop(), 1);
    EXPECT_EQ(queue.pop(), std::nullopt);
}

}  // namespace
}  // namespace isoglass
