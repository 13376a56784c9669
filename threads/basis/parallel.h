#pragma once

#include <cstddef>
#include <functional>

namespace isoglass {

/// Runs `body(begin, end)` over [0, count) in chunks of `grain` indices (the last may be shorter).
///
/// The one parallel seam: every parallel loop of the engine goes through it. The chunks are the same
/// for any number of threads, so a body that writes only to places of its own chunk gives the same
/// bytes whatever `threads` is. `threads` = 0 takes all cores, 1 runs in the calling thread in order.
/// Call it from any thread; it returns when all chunks are done. The first exception that a body
/// throws is rethrown here after the running chunks have ended.
void parallelFor(std::size_t count, std::size_t grain, int threads,
                 const std::function<void(std::size_t begin, std::size_t end)>& body);

}  // namespace isoglass
