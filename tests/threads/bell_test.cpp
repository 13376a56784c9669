#include "basis/bell.h"

#include "basis/mailbox.h"
#include "threads/eventually.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stop_token>
#include <thread>

namespace isoglass {
namespace {

TEST(Bell, ARingBeforeTheWaitIsKeptAndSeveralAreOne) {
    Bell bell;
    bell.ring();
    bell.ring();
    std::stop_source stop;
    EXPECT_TRUE(bell.wait(stop.get_token()));
    // Were the second ring still there, the wait would answer true before the stop.
    std::jthread stopper([&] { stop.request_stop(); });
    EXPECT_FALSE(bell.wait(stop.get_token()));
}

TEST(Bell, StopEndsAWaitEvenWhereItWasRung) {
    Bell bell;
    std::stop_source stop;
    stop.request_stop();
    EXPECT_FALSE(bell.wait(stop.get_token()));
    bell.ring();
    EXPECT_FALSE(bell.wait(stop.get_token()));
}

/// Nothing that was posted is slept through: the waiter sees the last value of both boxes.
TEST(Bell, TheLastPostOfSeveralBoxesAlwaysWakes) {
    constexpr int kLast = 2000;
    Bell bell;
    Mailbox<int> left(&bell), right(&bell);
    std::atomic<int> newestLeft{0}, newestRight{0};
    std::jthread waiter([&](std::stop_token stop) {
        while (bell.wait(stop)) {
            if (const auto value = left.tryTake()) newestLeft = *value;
            if (const auto value = right.tryTake()) newestRight = *value;
        }
    });
    std::jthread poster([&] {
        for (int i = 1; i <= kLast; ++i) left.post(i);
    });
    for (int i = 1; i <= kLast; ++i) right.post(i);
    EXPECT_TRUE(test::eventually([&] { return newestLeft == kLast && newestRight == kLast; }));
}

}  // namespace
}  // namespace isoglass
