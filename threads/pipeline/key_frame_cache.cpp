#include "pipeline/key_frame_cache.h"

#include "base/error.h"
#include "volume/detail_error.h"
#include "volume/pyramid.h"

#include <algorithm>
#include <chrono>
#include <string>

namespace isoglass {

namespace {

/// Until something was read.
constexpr double kFirstBytesPerSecond = 1e8;
/// How much of it the newest read decides.
constexpr double kNewestShare = 0.5;
/// Seconds that no read is shorter than, for what divides by them.
constexpr double kShortestRead = 1e-6;

/// As `--memory` takes it, rounded up.
std::string sizeText(std::size_t bytes) {
    if (bytes < 10'000'000) return std::to_string((bytes + 999) / 1000) + "kB";
    return std::to_string((bytes + 999'999) / 1'000'000) + "MB";
}

std::size_t bytesOf(const SeriesFile& series, std::size_t frame, KeyFrameCache::Frames kept) {
    const std::size_t plain = series.description().frames[frame].bytes;
    if (kept == KeyFrameCache::Frames::plain) return plain;
    const Lattice& lattice = series.description().lattice;
    const std::size_t errors =
        kept == KeyFrameCache::Frames::withErrors ? DetailError::largestBytes(lattice.cells()) : 0;
    return plain + Pyramid::largestBytes(lattice.dims(), plain) + errors;
}

/// Of the finest stored levels; 0 where there are none.
std::size_t largestLevel(const SeriesFile& series) {
    std::size_t largest = 0;
    for (const FrameRecord& frame : series.description().frames) {
        if (!frame.levels.empty()) largest = std::max<std::size_t>(largest, frame.levels.front().bytes);
    }
    return largest;
}

std::size_t largestFrame(const SeriesFile& series, KeyFrameCache::Frames kept) {
    std::size_t largest = 0;
    for (std::size_t i = 0; i < series.description().frames.size(); ++i)
        largest = std::max(largest, bytesOf(series, i, kept));
    return largest;
}

}  // namespace

/// A caller of `get`, while it is there. The mutex is held at both ends.
class KeyFrameCache::Waiting {
  public:
    explicit Waiting(KeyFrameCache& cache) : cache_(cache) { ++cache_.waiting_; }
    ~Waiting() {
        --cache_.waiting_;
        cache_.changed_.notify_all();
    }
    Waiting(const Waiting&) = delete;
    Waiting& operator=(const Waiting&) = delete;

  private:
    KeyFrameCache& cache_;
};

KeyFrameCache::KeyFrameCache(std::vector<std::shared_ptr<const SeriesFile>> series, std::size_t budgetBytes,
                             Frames kept, std::function<void()> arrived)
    : series_(std::move(series)), budget_(budgetBytes), kept_(kept), arrived_(std::move(arrived)) {
    bytesPerSecond_.fill(kFirstBytesPerSecond);
    for (const auto& file : series_) {
        const std::size_t needed = 2 * largestFrame(*file, kept_);
        if (needed > budget_) {
            throw Error("the memory budget of " + sizeText(budget_) + " cannot hold two key frames",
                        file->path().string(), "give at least --memory " + sizeText(needed));
        }
    }
    thread_ = std::jthread([this](std::stop_token stop) { prefetch(stop); });
}

KeyFrameCache::~KeyFrameCache() = default;

std::shared_ptr<const KeyFrame> KeyFrameCache::get(FrameKey key) {
    Lock lock(mutex_);
    const Waiting waiting(*this);
    std::shared_ptr<const KeyFrame> frame;
    bool room = false;
    // What is being read may be this frame, or may take its room until it is there and can be dropped.
    changed_.wait(lock, [&] {
        if (reading_.contains(key)) return false;
        const auto found = frames_.find(key);
        if (found != frames_.end()) {
            frame = found->second;
            return true;
        }
        room = makeRoom(expectedBytes(key), {});
        return room || reading_.empty();
    });
    if (frame) return frame;
    if (!room) {
        throw Error("the memory budget of " + sizeText(budget_) + " is used up by frames in use",
                    series_[key.series]->path().string(), "give a larger --memory");
    }
    return read(lock, key);
}

void KeyFrameCache::want(std::vector<FrameKey> keys) {
    const std::scoped_lock lock(mutex_);
    wanted_ = std::move(keys);
    changed_.notify_all();
}

double KeyFrameCache::expectedSeconds(FrameKey key) const {
    const std::scoped_lock lock(mutex_);
    if (frames_.contains(key) || failed_.contains(key)) return 0;
    // A small level says more of how long a disk takes to begin than of how much it brings.
    const double rate = key.level > 0 ? std::max(bytesPerSecond_[0], bytesPerSecond_[1]) : bytesPerSecond_[0];
    return static_cast<double>(expectedBytes(key)) / rate;
}

std::uint64_t KeyFrameCache::arrivals() const {
    const std::scoped_lock lock(mutex_);
    return arrivals_;
}

std::size_t KeyFrameCache::bytes() const {
    const std::scoped_lock lock(mutex_);
    return cachedBytes_ + readingBytes_;
}

bool KeyFrameCache::fitsMomentWithLevels() const {
    std::size_t sum = 0;
    for (const auto& file : series_) sum += 2 * (largestFrame(*file, kept_) + largestLevel(*file));
    return sum <= budget_;
}

bool KeyFrameCache::holds(FrameKey key) const {
    const std::scoped_lock lock(mutex_);
    return frames_.contains(key);
}

std::size_t KeyFrameCache::expectedBytes(FrameKey key) const {
    const SeriesFile& series = *series_[key.series];
    if (key.level > 0) return series.description().frames[key.frame].levels[key.level - 1].bytes;
    return bytesOf(series, key.frame, kept_);
}

/// Drops frames that nobody holds until `bytes` more fit: first those that nobody wants, then the ones
/// wanted last, but none of `keep`. False where that is not enough. The mutex is held.
bool KeyFrameCache::makeRoom(std::size_t bytes, const std::set<FrameKey>& keep) {
    const auto fits = [&] { return cachedBytes_ + readingBytes_ + bytes <= budget_; };
    const auto rank = [&](FrameKey key) {
        return std::find(wanted_.begin(), wanted_.end(), key) - wanted_.begin();
    };
    while (!fits()) {
        auto victim = frames_.end();
        for (auto it = frames_.begin(); it != frames_.end(); ++it) {
            const bool free = it->second.use_count() == 1 && !keep.contains(it->first);
            if (free && (victim == frames_.end() || rank(it->first) > rank(victim->first))) victim = it;
        }
        if (victim == frames_.end()) return false;
        cachedBytes_ -= expectedBytes(victim->first);
        frames_.erase(victim);
    }
    return true;
}

/// Reads with the mutex released; room must have been made.
std::shared_ptr<const KeyFrame> KeyFrameCache::read(Lock& lock, FrameKey key) {
    const std::size_t bytes = expectedBytes(key);
    reading_.insert(key);
    readingBytes_ += bytes;
    std::shared_ptr<const KeyFrame> frame;
    std::exception_ptr failure;
    lock.unlock();
    const auto begin = std::chrono::steady_clock::now();
    try {
        frame = readFile(key);
    } catch (...) {
        failure = std::current_exception();
    }
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
    lock.lock();
    reading_.erase(key);
    readingBytes_ -= bytes;
    changed_.notify_all();
    if (failure) std::rethrow_exception(failure);
    double& rate = bytesPerSecond_[key.level > 0];
    const double newest = static_cast<double>(bytes) / std::max(taken.count(), kShortestRead);
    rate += kNewestShare * (newest - rate);
    cachedBytes_ += bytes;
    failed_.erase(key);
    frames_[key] = frame;
    return frame;
}

std::shared_ptr<const KeyFrame> KeyFrameCache::readFile(FrameKey key) const {
    const SeriesFile& series = *series_[key.series];
    if (key.level > 0) return series.readLevel(key.frame, key.level);
    auto frame = series.read(key.frame);
    if (kept_ == Frames::withLevels) frame->pyramid();
    if (kept_ == Frames::withErrors) frame->detailError();
    return frame;
}

/// The first wanted frame that is missing and fits without dropping one that is wanted before it. The
/// mutex is held.
std::optional<FrameKey> KeyFrameCache::nextToPrefetch() {
    if (waiting_ > 0) return std::nullopt;
    std::set<FrameKey> keep;
    for (const FrameKey key : wanted_) {
        const bool there = frames_.contains(key) || reading_.contains(key) || failed_.contains(key);
        if (!there) return makeRoom(expectedBytes(key), keep) ? std::optional(key) : std::nullopt;
        keep.insert(key);
    }
    return std::nullopt;
}

void KeyFrameCache::prefetch(std::stop_token stop) {
    Lock lock(mutex_);
    while (!stop.stop_requested()) {
        const std::optional<FrameKey> key = nextToPrefetch();
        if (!key) {
            changed_.wait(lock, stop, [this] { return nextToPrefetch().has_value(); });
            continue;
        }
        try {
            read(lock, *key);
        } catch (const std::exception&) {
            // `get` reads it again and reports to the one who needs it.
            failed_.insert(*key);
        }
        ++arrivals_;
        if (!arrived_) continue;
        lock.unlock();
        arrived_();
        lock.lock();
    }
}

}  // namespace isoglass
