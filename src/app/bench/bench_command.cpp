#include "app/bench/benches.h"
#include "app/commands.h"
#include "app/text.h"
#include "base/error.h"

#include <benchmark/benchmark.h>
#include <nlohmann/json.hpp>
#include <sys/resource.h>

#include <iostream>
#include <sstream>
#include <thread>

namespace isoglass {

namespace {

/// Peak resident memory of the whole process so far.
double peakMegabytes() {
    rusage usage{};
    ::getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_maxrss) / 1024;
}

/// Prints the median of each benchmark as it is known.
class Reporter final : public benchmark::BenchmarkReporter {
  public:
    explicit Reporter(bool json) : json_(json) {}

    bool ReportContext(const Context&) override { return true; }

    void ReportRuns(const std::vector<Run>& runs) override {
        for (const Run& run : runs) {
            if (run.error_occurred) throw std::runtime_error(run.benchmark_name() + ": " + run.error_message);
            if (run.aggregate_name == "median") report(run);
        }
    }

  private:
    static double counter(const Run& run, const char* name) {
        const auto found = run.counters.find(name);
        return found == run.counters.end() ? 0 : static_cast<double>(found->second);
    }

    void report(const Run& run) const {
        const std::string full = run.run_name.function_name;
        const std::string name = full.substr(0, full.find('/'));
        const double threads = counter(run, "threads");
        nlohmann::ordered_json line = {{"name", name},
                                       {"size", static_cast<int>(counter(run, "size"))},
                                       {"threads", threads > 0 ? static_cast<int>(threads) : cores()},
                                       {"median_ms", run.GetAdjustedRealTime()},
                                       {"triangles", static_cast<std::int64_t>(counter(run, "triangles"))},
                                       {"peak_rss_mb", peakMegabytes()}};
        if (!run.report_label.empty()) line["clock"] = run.report_label;
        if (json_) {
            std::cout << line.dump() << std::endl;
        } else {
            std::cout << name << " at " << line["size"] << ": " << formatNumber(run.GetAdjustedRealTime())
                      << " ms, " << line["triangles"] << " triangles" << std::endl;
        }
    }

    static int cores() { return static_cast<int>(std::thread::hardware_concurrency()); }

    bool json_;
};

/// The names as one regular expression that matches any of them literally.
std::string filterFor(const std::vector<std::string>& names) {
    std::string filter;
    for (const std::string& name : names) {
        if (!filter.empty()) filter += '|';
        for (const char c : name) {
            if (!std::isalnum(static_cast<unsigned char>(c)) && c != '-' && c != '/') filter += '\\';
            filter += c;
        }
    }
    return filter.empty() ? "all" : filter;
}

std::string nameList(const std::vector<std::string>& names) {
    std::string list;
    for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
    return list;
}

}  // namespace

void runBench(const BenchCommand& command, const CommonOptions& common) {
    registerExtraction(common.threads, command.repetitions);
    registerDetail(common.threads, command.repetitions);
    registerPasses(command.repetitions);
    Reporter reporter(command.json);
    std::ostringstream libraryErrors;
    reporter.SetErrorStream(&libraryErrors);
    const std::size_t ran = benchmark::RunSpecifiedBenchmarks(&reporter, filterFor(command.names));
    benchmark::ClearRegisteredBenchmarks();
    if (ran == 0) throw Error("no benchmark has such a name", nameList(command.names));
}

}  // namespace isoglass
