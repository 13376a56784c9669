#include "volume/series_set.h"

#include "base/error.h"
#include "unit/volume/series_fixture.h"

#include <gtest/gtest.h>

#include <functional>

namespace isoglass {
namespace {

using test::MemorySource;

const glm::ivec3 kDims(9, 10, 3);

class SeriesSet : public testing::Test {
  protected:
    ScratchFolder folder_;

    /// A file with key frames at `times`, their samples random by the time.
    std::filesystem::path write(const std::string& name, const std::vector<double>& times,
                                const std::function<void(SeriesDescription&)>& change = {}) const {
        SeriesDescription series =
            test::describe(makeUniformLattice(kDims, glm::dvec3(0), glm::dvec3(1)), times.size());
        series.time.times = times;
        series.time.units = "s";
        if (change) change(series);
        std::vector<std::vector<float>> frames;
        for (const double time : times) frames.push_back(samplesAt(time));
        MemorySource source(series, frames);
        writeSeries(source, folder_ / name);
        return folder_ / name;
    }

    static std::vector<float> samplesAt(double time) {
        return randomFloats(kDims, static_cast<std::uint32_t>(time * 10));
    }

    static void expectTimes(const SeriesFile& series, const std::vector<double>& times) {
        ASSERT_EQ(series.description().time.times, times);
        ASSERT_EQ(series.description().frames.size(), times.size());
        for (std::size_t i = 0; i < times.size(); ++i)
            EXPECT_EQ(test::firstDifference(*series.read(i), samplesAt(times[i])), -1) << times[i];
    }

    static std::string messageOf(const std::vector<std::filesystem::path>& names) {
        try {
            openSeriesSet(names);
        } catch (const Error& error) {
            return error.what();
        }
        return "no error";
    }

    static void expectContains(const std::string& message, const std::vector<std::string>& parts) {
        for (const std::string& part : parts)
            EXPECT_NE(message.find(part), std::string::npos) << part << " is not in: " << message;
    }
};

TEST_F(SeriesSet, KeyFramesAreInTheOrderOfTheirTimesWhateverTheFiles) {
    const auto late = write("late.vdb", {7, 9});
    const auto single = write("single.vdb", {8});
    const auto early = write("early.vdb", {0.5, 2, 3});
    expectTimes(*openSeriesSet(std::vector{late, single, early}), {0.5, 2, 3, 7, 8, 9});
    expectTimes(*openSeriesSet(std::vector{single}), {8});
}

TEST_F(SeriesSet, PatternFindsFilesByName) {
    for (const int i : {10, 2, 1}) write("step-" + std::to_string(i) + ".vdb", {double(i)});
    write("other.vdb", {99});
    expectTimes(*openSeriesSet(std::vector{folder_ / "step-*.vdb"}), {1, 2, 10});
    expectTimes(*openSeriesSet(std::vector{folder_ / "step-?.vdb"}), {1, 2});
    expectTimes(*openSeriesSet(std::vector{folder_ / "step-?.vdb", folder_ / "other.vdb"}), {1, 2, 99});
    expectContains(messageOf({folder_ / "none-*.vdb"}), {"no file has such a name", "none-*.vdb"});
    expectContains(messageOf({folder_ / "absent" / "*.vdb"}), {"cannot look into the folder", "absent"});
}

TEST_F(SeriesSet, FilesThatAreNotOneSeriesAreNamedWithWhatDiffers) {
    const auto first = write("first.vdb", {0});
    const auto expectRefused = [&](const std::function<void(SeriesDescription&)>& change,
                                   const std::string& says) {
        const auto other = write("other.vdb", {1}, change);
        expectContains(messageOf({first, other}), {"first.vdb", "(" + other.string() + ")", says});
    };
    expectRefused([](auto& series) { series.name = "cloud"; }, "holds 'cloud', not 'field'");
    expectRefused([](auto& series) { series.units = "K"; }, "units 'K'");
    expectRefused([](auto& series) { series.lattice.axes[1].coordinates[4] += 0.25; }, "another y axis");
    expectRefused([](auto& series) { series.time.units = "h"; }, "times in 'h'");
    expectContains(messageOf({first, write("same.vdb", {0})}), {"at time 0", "first.vdb", "same.vdb"});
}

TEST_F(SeriesSet, DamagedAndMissingFilesAreNamed) {
    const auto first = write("first.vdb", {0});
    const auto second = write("second.vdb", {1});
    expectContains(messageOf({first, folder_ / "absent.vdb"}), {"no such file", "absent.vdb"});
    std::string bytes = test::bytesOf(second);
    bytes[bytes.size() / 2] ^= 1;
    test::writeBytes(second, bytes);
    expectContains(messageOf({first, second}), {"damaged", "second.vdb"});
}

TEST_F(SeriesSet, FileThatChangesWhileItIsInUseIsAnError) {
    const auto first = write("first.vdb", {0});
    const auto second = write("second.vdb", {1});
    const auto series = openSeriesSet(std::vector{first, second});
    write("second.vdb", {3});
    EXPECT_THROW(series->read(1), Error);
    EXPECT_EQ(test::firstDifference(*series->read(0), samplesAt(0)), -1);
}

/// One file a key frame, more than a process may have open.
TEST_F(SeriesSet, ManyFilesAreNotKeptOpen) {
    const auto openFiles = [] {
        return std::distance(std::filesystem::directory_iterator("/proc/self/fd"), {});
    };
    std::vector<std::filesystem::path> names;
    for (int i = 0; i < 5; ++i) names.push_back(write(std::to_string(i) + ".vdb", {double(i)}));
    const auto before = openFiles();
    const auto series = openSeriesSet(names);
    for (std::size_t i = 0; i < 5; ++i) series->read(i);
    EXPECT_EQ(openFiles(), before);
}

}  // namespace
}  // namespace isoglass
