#include "formats/isolated_source.h"
#include "unit/formats/small_files.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstdlib>
#include <iostream>

namespace isoglass {

namespace {

using test::failsWith;

/// A source of two key frames that does as told when it is opened or read.
class ToldSource final : public FrameSource {
  public:
    explicit ToldSource(std::function<void(std::size_t)> read) : read_(std::move(read)) {
        description_.name = "told";
        description_.lattice = makeUniformLattice({2, 3, 4}, glm::dvec3(0.1), glm::dvec3(1.0 / 3));
        description_.time.times = {0.1, 0.2};
        description_.notes = {"a note"};
    }
    const SeriesDescription& description() const override { return description_; }
    void read(std::size_t frame, std::span<float> samples) override {
        read_(frame);
        for (std::size_t i = 0; i < samples.size(); ++i) samples[i] = static_cast<float>(100 * frame + i);
        samples[5] = std::numeric_limits<float>::quiet_NaN();
    }
    void readHeights(std::size_t frame, std::span<float> heights) override {
        for (std::size_t i = 0; i < heights.size(); ++i) heights[i] = static_cast<float>(1000 * frame + i);
    }

    void useHeights() { description_.lattice.heights = HeightField{"PH / 9.81", "m"}; }

  private:
    SeriesDescription description_;
    std::function<void(std::size_t)> read_;
};

std::unique_ptr<FrameSource> open(const std::function<void(std::size_t)>& read) {
    const std::vector<std::filesystem::path> files = {"told.xyz"};
    return openIsolated(files, [&] { return std::make_unique<ToldSource>(read); });
}

TEST(Isolated, GivesWhatTheSourceGives) {
    const auto source = open([](std::size_t) {});
    ToldSource wanted([](std::size_t) {});
    EXPECT_EQ(source->description().name, "told");
    EXPECT_EQ(source->description().time.times, wanted.description().time.times);
    EXPECT_EQ(source->description().notes, wanted.description().notes);
    EXPECT_TRUE(source->description().frames.empty());
    for (std::size_t k = 0; k < 3; ++k)
        EXPECT_EQ(source->description().lattice.axes[k].coordinates,
                  wanted.description().lattice.axes[k].coordinates);
    for (const std::size_t frame : {1, 0, 0, 1}) {
        const auto samples = test::readFrame(*source, frame);
        EXPECT_EQ(samples[23], static_cast<float>(100 * frame + 23));
        EXPECT_TRUE(std::isnan(samples[5]));
    }
}

TEST(Isolated, GivesHeightsBetweenSamples) {
    const std::vector<std::filesystem::path> files = {"told.xyz"};
    const auto source = openIsolated(files, [] {
        auto told = std::make_unique<ToldSource>([](std::size_t) {});
        told->useHeights();
        return told;
    });
    ASSERT_TRUE(source->description().lattice.heights);
    EXPECT_EQ(source->description().lattice.heights->name, "PH / 9.81");
    std::vector<float> heights(24);
    for (const std::size_t frame : {0, 1}) {
        EXPECT_EQ(test::readFrame(*source, frame)[23], static_cast<float>(100 * frame + 23));
        source->readHeights(frame, heights);
        EXPECT_EQ(heights[23], static_cast<float>(1000 * frame + 23));
        EXPECT_EQ(test::readFrame(*source, frame)[23], static_cast<float>(100 * frame + 23));
    }
}

TEST(Isolated, ErrorsPassWithTheirText) {
    EXPECT_TRUE(failsWith([] { open([](std::size_t) { throw Error("broken", "here", "mend it"); }); },
                          {"broken (here); mend it"}));
    const auto source = open([](std::size_t frame) {
        if (frame == 1) throw std::runtime_error("broken later");
    });
    EXPECT_TRUE(failsWith([&] { test::readFrame(*source, 1); }, {"broken later"}));
    EXPECT_EQ(test::readFrame(*source, 0)[1], 1) << "an error is not the end";
}

/// Ends this process as a bad access does; without the handler by which the address sanitizer would report it.
void crash(int signal) {
    std::signal(signal, SIG_DFL);
    std::raise(signal);
}

TEST(Isolated, CrashIsAnError) {
    EXPECT_TRUE(failsWith([] { open([](std::size_t) { crash(SIGSEGV); }); }, {"crashed", "told.xyz"}));
    EXPECT_TRUE(failsWith([] { open([](std::size_t) { std::abort(); }); }, {"crashed", "told.xyz"}));
    EXPECT_TRUE(failsWith([] { open([](std::size_t) { ::_exit(3); }); }, {"reader ended", "told.xyz"}));
    const auto source = open([](std::size_t frame) {
        if (frame == 1) crash(SIGBUS);
    });
    EXPECT_TRUE(failsWith([&] { test::readFrame(*source, 1); }, {"crashed", "told.xyz"}));
    EXPECT_TRUE(failsWith([&] { test::readFrame(*source, 0); }, {"failed before", "told.xyz"}));
}

TEST(Isolated, AbsurdMemoryIsAnError) {
    // More than any machine has. The sanitizers end the process instead of throwing.
    const auto message = [] { open([](std::size_t) { std::vector<char> all(std::size_t{1} << 46); }); };
    EXPECT_TRUE(failsWith(message, {"more memory than there is", "told.xyz"}) ||
                failsWith(message, {"its reader", "told.xyz"}));
}

TEST(Isolated, ReaderThatNeverEndsIsAnError) {
    EXPECT_TRUE(failsWith(
        [] {
            open([](std::size_t) {
                // A second instead of twenty.
                const rlimit limit{1, 2};
                ::setrlimit(RLIMIT_CPU, &limit);
                std::atomic<int> turns = 0;
                for (;;) ++turns;
            });
        },
        {"did not come to an end", "told.xyz"}));
}

TEST(Isolated, WhatTheReaderPrintsIsDropped) {
    testing::internal::CaptureStderr();
    testing::internal::CaptureStdout();
    open([](std::size_t) {
        std::cerr << "noise" << std::endl;
        std::cout << "noise" << std::endl;
    });
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
    EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
}

}  // namespace

}  // namespace isoglass
