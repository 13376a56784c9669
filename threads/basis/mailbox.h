#pragma once

#include "basis/bell.h"

#include <condition_variable>
#include <mutex>
#include <optional>
#include <stop_token>
#include <utility>

namespace isoglass {

/// Holds the newest value that one thread hands to another; an older one that nobody took is dropped.
///
/// Any number of threads may call any member. `post` and `tryTake` never wait for the other side.
template <typename T>
class Mailbox {
  public:
    /// `bell`, where there is one, rings after every post. It must outlive the box.
    explicit Mailbox(Bell* bell = nullptr) : bell_(bell) {}

    /// Puts `value` in place of whatever lies in the box.
    void post(T value) {
        std::optional<T> dropped(std::move(value));
        {
            const std::scoped_lock lock(mutex_);
            std::swap(value_, dropped);
        }
        arrived_.notify_one();
        if (bell_ != nullptr) bell_->ring();
    }

    /// Takes the value if there is one.
    std::optional<T> tryTake() {
        const std::scoped_lock lock(mutex_);
        return std::exchange(value_, std::nullopt);
    }

    /// Waits for a value; nothing once `stop` was requested, whatever lies in the box.
    std::optional<T> take(std::stop_token stop) {
        std::unique_lock lock(mutex_);
        arrived_.wait(lock, stop, [this] { return value_.has_value(); });
        if (stop.stop_requested()) return std::nullopt;
        return std::exchange(value_, std::nullopt);
    }

  private:
    Bell* const bell_;
    std::mutex mutex_;
    std::condition_variable_any arrived_;
    std::optional<T> value_;
};

}  // namespace isoglass
