#pragma once

#include <chrono>
#include <thread>

namespace isoglass::test {

/// Whether `claim` becomes true. Gives up after half a minute, so that a broken program fails its test
/// instead of hanging in it.
template <typename Claim>
bool eventually(Claim claim) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(30);
    while (!claim()) {
        if (std::chrono::steady_clock::now() > end) return false;
        std::this_thread::yield();
    }
    return true;
}

}  // namespace isoglass::test
