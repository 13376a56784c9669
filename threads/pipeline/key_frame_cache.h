#pragma once

#include "volume/key_frame.h"
#include "volume/series_file.h"

#include <array>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <thread>
#include <vector>

namespace isoglass {

/// Names a key frame among several series, or one of its stored levels.
struct FrameKey {
    std::size_t series = 0;
    std::size_t frame = 0;
    int level = 0;  ///< above 0: that coarser level alone

    friend auto operator<=>(const FrameKey&, const FrameKey&) = default;
};

/// Key frames of all series of a scene, read ahead by a thread of its own, under a hard memory budget. Their
/// stored levels count as frames of their own, without what is kept of a key frame.
///
/// Frames count against the budget while they are cached, being read, or held by a caller. Any thread
/// may call any member; one thread at a time may hold frames across calls of `get`.
class KeyFrameCache {
  public:
    /// What is kept of a key frame.
    enum class Frames {
        plain,
        withLevels,  ///< its pyramid, too: built where it is read, and counted with what it may take at most
        withErrors,  ///< and what the coarser levels lack, likewise
    };

    /// `arrived` runs on the reading thread after a frame was read ahead, or could not be; it must not throw.
    /// Throws Error where the budget cannot hold two key frames of every series: one moment between key
    /// frames needs two.
    KeyFrameCache(std::vector<std::shared_ptr<const SeriesFile>> series, std::size_t budgetBytes,
                  Frames kept = Frames::plain, std::function<void()> arrived = {});
    ~KeyFrameCache();

    /// The key frame; waits for the disk where it is not there yet. Hand back (drop) frames that are no
    /// longer needed before asking for others. Throws Error where it cannot be read.
    std::shared_ptr<const KeyFrame> get(FrameKey key);

    /// Says which frames will be needed, the next one first. They are read while nobody waits, as far as
    /// the budget reaches; a frame that cannot be read is left for `get` to report.
    void want(std::vector<FrameKey> keys);

    /// How long it takes to read a frame, judged by what was read before: 0 where it is in memory, or could
    /// not be read ahead, so that `get` will say why.
    double expectedSeconds(FrameKey key) const;
    /// Frames that were read ahead since the beginning, or could not be.
    std::uint64_t arrivals() const;

    /// Bytes of all frames that are cached, held or being read; never above the budget.
    std::size_t bytes() const;
    std::size_t budgetBytes() const { return budget_; }
    /// Whether two key frames of every series fit all at once, beside two levels that are shown in their
    /// place. Where they do not, showing levels would take the room of what they stand for.
    bool fitsMomentWithLevels() const;
    /// Whether the frame is in memory, for tests and progress.
    bool holds(FrameKey key) const;

  private:
    using Lock = std::unique_lock<std::mutex>;
    class Waiting;

    std::size_t expectedBytes(FrameKey key) const;
    bool makeRoom(std::size_t bytes, const std::set<FrameKey>& keep);
    std::shared_ptr<const KeyFrame> read(Lock& lock, FrameKey key);
    std::shared_ptr<const KeyFrame> readFile(FrameKey key) const;
    std::optional<FrameKey> nextToPrefetch();
    void prefetch(std::stop_token stop);

    const std::vector<std::shared_ptr<const SeriesFile>> series_;
    const std::size_t budget_;
    const Frames kept_;
    const std::function<void()> arrived_;

    mutable std::mutex mutex_;
    std::condition_variable_any changed_;
    std::map<FrameKey, std::shared_ptr<const KeyFrame>> frames_;
    std::set<FrameKey> reading_;
    std::set<FrameKey> failed_;
    std::vector<FrameKey> wanted_;
    std::size_t cachedBytes_ = 0;
    std::size_t readingBytes_ = 0;
    std::uint64_t arrivals_ = 0;
    std::array<double, 2> bytesPerSecond_;  ///< of key frames, and of stored levels
    int waiting_ = 0;  ///< callers of `get` that need the disk; prefetching steps back for them

    std::jthread thread_;  ///< last member: it uses all the others
};

}  // namespace isoglass
