#pragma once

#include <benchmark/benchmark.h>

#include <functional>
#include <string>

namespace isoglass {

/// Registers a benchmark whose loop runs by the wall clock; its median of `repetitions` is reported.
void registerByWallClock(const std::string& name, int repetitions,
                         std::function<void(benchmark::State&)> run);

}  // namespace isoglass
