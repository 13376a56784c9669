#include "app/bench/registration.h"

#include <utility>

namespace isoglass {

void registerByWallClock(const std::string& name, int repetitions,
                         std::function<void(benchmark::State&)> run) {
    benchmark::RegisterBenchmark(name.c_str(), std::move(run))
        ->Repetitions(repetitions)
        ->ReportAggregatesOnly()
        ->MinTime(0.05)
        ->UseRealTime()
        ->Unit(benchmark::kMillisecond);
}

}  // namespace isoglass
