#pragma once

#include <condition_variable>
#include <mutex>
#include <stop_token>
#include <utility>

namespace isoglass {

/// Wakes one thread that waits for news from several senders, such as the mailboxes that ring it.
///
/// Any number of threads may ring; one waits. A ring that nobody waits for is kept; several of them wake
/// once. Whoever wakes looks at all that the bell stands for.
class Bell {
  public:
    void ring() {
        {
            const std::scoped_lock lock(mutex_);
            rung_ = true;
        }
        changed_.notify_one();
    }

    /// Waits until the bell is rung, or was since the last wait. False once `stop` was requested.
    bool wait(std::stop_token stop) {
        std::unique_lock lock(mutex_);
        changed_.wait(lock, stop, [this] { return rung_; });
        return !stop.stop_requested() && std::exchange(rung_, false);
    }

  private:
    std::mutex mutex_;
    std::condition_variable_any changed_;
    bool rung_ = false;
};

}  // namespace isoglass
