#include "basis/parallel.h"

#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <map>
#include <mutex>

namespace isoglass {

namespace {

/// One for each number of threads, kept to the end: the memory of arenas that are made for a loop and dropped
/// grew by 20 kB a displayed frame.
tbb::task_arena& arenaOf(int threads) {
    static std::mutex mutex;
    static std::map<int, tbb::task_arena> arenas;
    const std::scoped_lock lock(mutex);
    return arenas.try_emplace(threads, threads).first->second;
}

}  // namespace

void parallelFor(std::size_t count, std::size_t grain, int threads,
                 const std::function<void(std::size_t, std::size_t)>& body) {
    const std::size_t chunks = (count + grain - 1) / grain;
    const auto runChunk = [&](std::size_t chunk) {
        body(chunk * grain, std::min(count, (chunk + 1) * grain));
    };
    if (threads == 1 || chunks < 2) {
        for (std::size_t chunk = 0; chunk < chunks; ++chunk) runChunk(chunk);
        return;
    }
    const auto loop = [&] { tbb::parallel_for(std::size_t{0}, chunks, runChunk, tbb::simple_partitioner{}); };
    if (threads == 0) {
        loop();
    } else {
        // More threads than TBB runs would only make it print a warning.
        arenaOf(std::min(threads, tbb::info::default_concurrency())).execute(loop);
    }
}

}  // namespace isoglass
