// What stored levels are worth: the time to read a key frame, to build its pyramid once it is there, and to
// read each stored level alone, from a file that the system does not remember (cold) and from one that it
// does (warm). Medians; a line of JSON for each.
//
//     level_reading [SAMPLES]...
//
// For blobs of SAMPLES^3 samples, 128 and 256 if none are given. Writes a file into the working folder, and
// removes it.
#include "volume/analytic.h"
#include "volume/detail_error.h"
#include "volume/pyramid.h"
#include "volume/series_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <string>
#include <vector>

namespace isoglass {
namespace {

constexpr int kRuns = 7;

class BlobsSource final : public FrameSource {
  public:
    explicit BlobsSource(int samples) {
        series_.name = "blobs";
        series_.lattice = makeUnitLattice(samples);
        series_.time.times = {0};
    }
    const SeriesDescription& description() const override { return series_; }
    void read(std::size_t, std::span<float> out) override {
        std::ranges::copy(sampleField(series_.lattice, blobs, 0), out.begin());
    }

  private:
    SeriesDescription series_;
};

void forget(const std::filesystem::path& path) {
    const int file = ::open(path.c_str(), O_RDONLY);
    ::fsync(file);
    ::posix_fadvise(file, 0, 0, POSIX_FADV_DONTNEED);
    ::close(file);
}

double medianMilliseconds(const std::function<void()>& prepare, const std::function<void()>& act) {
    std::vector<double> times;
    for (int run = 0; run < kRuns; ++run) {
        prepare();
        const auto begin = std::chrono::steady_clock::now();
        act();
        times.push_back(
            std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count());
    }
    std::ranges::nth_element(times, times.begin() + kRuns / 2);
    return times[kRuns / 2];
}

void measure(int samples) {
    const std::filesystem::path path = "level_reading.vdb";
    BlobsSource source(samples);
    writeSeries(source, path);
    const SeriesFile file(path);
    const FrameRecord& record = file.description().frames[0];
    for (int level = 0; level <= static_cast<int>(record.levels.size()); ++level) {
        const auto read = [&] { file.readLevel(0, level); };
        const double cold = medianMilliseconds([&] { forget(path); }, read);
        const double warm = medianMilliseconds([] {}, read);
        std::printf(R"({"samples": %d, "level": %d, "bytes": %zu, "cold_ms": %.2f, "warm_ms": %.2f})"
                    "\n",
                    samples, level,
                    static_cast<std::size_t>(level ? record.levels[level - 1].bytes : record.bytes), cold,
                    warm);
    }
    std::shared_ptr<const KeyFrame> frame;
    const auto readAgain = [&] { frame = file.read(0); };
    const double pyramid = medianMilliseconds(readAgain, [&] { frame->pyramid(); });
    const double errors =
        medianMilliseconds([&] { readAgain(), frame->pyramid(); }, [&] { frame->detailError(); });
    std::printf(R"({"samples": %d, "build_pyramid_ms": %.2f, "build_errors_ms": %.2f})"
                "\n",
                samples, pyramid, errors);
    std::filesystem::remove(path);
}

}  // namespace
}  // namespace isoglass

int main(int argc, char** argv) {
    std::vector<int> sizes;
    for (int i = 1; i < argc; ++i) sizes.push_back(std::atoi(argv[i]));
    if (sizes.empty()) sizes = {128, 256};
    for (const int samples : sizes) isoglass::measure(samples);
}
