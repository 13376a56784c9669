#include "base/error.h"
#include "support/file_size_limit.h"
#include "unit/volume/series_fixture.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <functional>

namespace isoglass {
namespace {

using test::MemorySource;

MemorySource makeSource(std::size_t frames = 2) {
    const glm::ivec3 dims(17, 9, 9);
    const Lattice lattice = makeUniformLattice(dims, glm::dvec3(0), glm::dvec3(1));
    std::vector<std::vector<float>> samples;
    for (std::uint32_t i = 0; i < frames; ++i) {
        samples.push_back(randomFloats(dims, i));
        removeSamples(samples.back(), 10, i + 50);
    }
    return {test::describe(lattice, frames), samples};
}

std::string messageOf(const std::function<void()>& action) {
    try {
        action();
    } catch (const Error& error) {
        return error.what();
    }
    return "no error";
}

bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

enum class Outcome { error, whole, different };

/// Opens and reads everything. Any exception but Error ends the test.
Outcome tryToRead(const std::filesystem::path& path, const MemorySource& source) {
    try {
        const SeriesFile file(path);
        for (std::size_t i = 0; i < 2; ++i) {
            const auto frame = file.read(i);
            if (frame->dims() != source.description().lattice.dims()) return Outcome::different;
            if (test::firstDifference(*frame, source.frame(i)) != -1) return Outcome::different;
        }
        return Outcome::whole;
    } catch (const Error&) {
        return Outcome::error;
    }
}

// OpenVDB itself would write beyond its buffers for some of these. A CRC sees every single flipped bit.
TEST(SeriesDamage, FlippedBitIsAnErrorWhereverItIs) {
    const ScratchFolder folder;
    MemorySource source = makeSource();
    const auto path = folder / "series.vdb";
    writeSeries(source, path);
    const std::string whole = test::bytesOf(path);
    ASSERT_EQ(tryToRead(path, source), Outcome::whole);
    for (std::size_t i = 0; i < whole.size(); i += i < whole.size() - 100 ? 61 : 1) {
        std::string damaged = whole;
        damaged[i] = static_cast<char>(damaged[i] ^ (1 << i % 8));
        test::writeBytes(path, damaged);
        EXPECT_EQ(tryToRead(path, source), Outcome::error) << "byte " << i << " of " << whole.size();
    }
}

TEST(SeriesDamage, TruncatedFileIsAnError) {
    const ScratchFolder folder;
    MemorySource source = makeSource();
    const auto path = folder / "series.vdb";
    writeSeries(source, path);
    const std::string whole = test::bytesOf(path);
    for (std::size_t length = 0; length < whole.size(); length += 1 + whole.size() / 400) {
        test::writeBytes(path, whole.substr(0, length));
        EXPECT_EQ(tryToRead(path, source), Outcome::error) << length << " of " << whole.size();
    }
    test::writeBytes(path, whole.substr(0, whole.size() - 1));
    EXPECT_EQ(tryToRead(path, source), Outcome::error);
}

TEST(SeriesDamage, WhatIsNoSeriesIsSaid) {
    const ScratchFolder folder;
    const auto path = folder / "file.vdb";
    EXPECT_TRUE(contains(messageOf([&] { SeriesFile file(path); }), "no such file"));
    for (const std::string& bytes : {std::string(), std::string("text"), std::string(10'000, 'x')}) {
        test::writeBytes(path, bytes);
        const std::string message = messageOf([&] { SeriesFile file(path); });
        EXPECT_TRUE(contains(message, "OpenVDB")) << message;
        EXPECT_TRUE(contains(message, path.string())) << message;
    }
    EXPECT_NE(messageOf([&] { SeriesFile file(folder.path()); }), "no error") << "a folder";
}

// Without the seal at its end it is a whole OpenVDB file as another program might make it.
TEST(SeriesDamage, OpenVdbFileOfAnotherProgramIsSaid) {
    const ScratchFolder folder;
    const auto path = folder / "series.vdb";
    MemorySource source = makeSource();
    writeSeries(source, path);
    const std::string bytes = test::bytesOf(path);
    const std::size_t seal = bytes.rfind("IsoGlass");
    ASSERT_EQ(seal, bytes.size() - 24);
    test::writeBytes(path, bytes.substr(0, seal));
    const std::string message = messageOf([&] { SeriesFile file(path); });
    EXPECT_TRUE(contains(message, "holds no IsoGlass series")) << message;
}

TEST(SeriesDamage, KeyFrameThatIsNotThereIsAnError) {
    const ScratchFolder folder;
    MemorySource source = makeSource();
    writeSeries(source, folder / "series.vdb");
    const SeriesFile file(folder / "series.vdb");
    EXPECT_TRUE(contains(messageOf([&] { file.read(2); }), "key frame 2"));
}

TEST(SeriesDisk, FullDiskLeavesNothingBehindAndTheOlderFileAsItWas) {
    MemorySource source = makeSource();
    rlim_t size = 0;
    {
        const ScratchFolder folder;
        writeSeries(source, folder / "series.vdb");
        size = static_cast<rlim_t>(std::filesystem::file_size(folder / "series.vdb"));
    }
    for (const rlim_t limit : {rlim_t{0}, rlim_t{10}, rlim_t{1000}, size / 2, size - 1}) {
        for (const bool older : {false, true}) {
            const ScratchFolder folder;
            const auto path = folder / "series.vdb";
            if (older) test::writeBytes(path, "older");
            std::string message;
            {
                const FileSizeLimit full(limit);
                message = messageOf([&] { writeSeries(source, path); });
            }
            EXPECT_TRUE(contains(message, path.string())) << message << " limit " << limit;
            EXPECT_EQ(folder.fileCount(), older ? 1u : 0u) << limit;
            EXPECT_TRUE(!older || test::bytesOf(path) == "older") << limit;
        }
    }
    const ScratchFolder folder;
    const FileSizeLimit enough(size);
    EXPECT_EQ(messageOf([&] { writeSeries(source, folder / "series.vdb"); }), "no error");
}

TEST(SeriesDisk, MissingFolderIsNamed) {
    MemorySource source = makeSource();
    const std::string message = messageOf([&] { writeSeries(source, "/nowhere/at/all/series.vdb"); });
    EXPECT_TRUE(contains(message, "/nowhere/at/all")) << message;
}

TEST(SeriesDisk, FolderThatCannotBeWrittenIsReported) {
    if (::geteuid() == 0) GTEST_SKIP() << "the superuser may write anywhere";
    const ScratchFolder folder;
    MemorySource source = makeSource();
    ::chmod(folder.path().c_str(), 0500);
    EXPECT_TRUE(
        contains(messageOf([&] { writeSeries(source, folder / "series.vdb"); }), "Permission denied"));
    ::chmod(folder.path().c_str(), 0700);
}

/// Fails in the middle, as a source on a lost network drive would.
class FailingSource final : public FrameSource {
  public:
    explicit FailingSource(MemorySource& source) : source_(source) {}
    const SeriesDescription& description() const override { return source_.description(); }
    void read(std::size_t frame, std::span<float> samples) override {
        if (frame == 1) throw Error("samples cannot be read", "source");
        source_.read(frame, samples);
    }

  private:
    MemorySource& source_;
};

TEST(SeriesDisk, FailingSourceLeavesTheOlderFile) {
    const ScratchFolder folder;
    MemorySource source = makeSource();
    FailingSource failing(source);
    test::writeBytes(folder / "series.vdb", "older");
    EXPECT_TRUE(
        contains(messageOf([&] { writeSeries(failing, folder / "series.vdb"); }), "samples cannot be read"));
    EXPECT_EQ(folder.fileCount(), 1u);
    EXPECT_EQ(test::bytesOf(folder / "series.vdb"), "older");
}

}  // namespace
}  // namespace isoglass
