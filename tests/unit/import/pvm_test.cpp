#include "unit/import/import_check.h"

#include <gtest/gtest.h>

#include <fstream>

namespace isoglass {

namespace {

using test::failsWith;
using test::readFrame;
using test::scratchFile;

std::filesystem::path writeFile(const std::string& ending, const std::string& content) {
    const std::filesystem::path path = scratchFile(ending);
    std::ofstream(path, std::ios::binary) << content;
    return path;
}

/// `count` bytes 0, 1, 2, ... from `first` on.
std::string ramp(int count, int first = 0) {
    std::string bytes;
    for (int i = 0; i < count; ++i) bytes += static_cast<char>(first + i);
    return bytes;
}

std::unique_ptr<FrameSource> open(const std::vector<std::filesystem::path>& files,
                                  const ImportOptions& options = {}) {
    return openPvm(files, options);
}

TEST(Pvm, BytesBecomeSamplesWithXFastest) {
    const auto source = open({writeFile("a.pvm", "PVM\n2 3 2\n1\n" + ramp(12, 244))});
    const SeriesDescription& description = source->description();
    EXPECT_EQ(description.lattice.axes[0].coordinates, (std::vector<double>{0, 1}));
    EXPECT_EQ(description.lattice.axes[1].coordinates, (std::vector<double>{0, 1, 2}));
    EXPECT_EQ(description.lattice.axes[2].name, "z");
    EXPECT_EQ(description.lattice.axes[2].units, "");
    EXPECT_EQ(description.time.times, std::vector<double>{0});
    EXPECT_EQ(readFrame(*source, 0),
              (std::vector<float>{244, 245, 246, 247, 248, 249, 250, 251, 252, 253, 254, 255}));
}

TEST(Pvm, TwoByteSamplesAreBigEndian) {
    const std::string bytes("\x00\x01\x01\x00\xff\xff\x80\x00\x00\x00\x12\x34\x00\xff\xff\x00", 16);
    const auto source = open({writeFile("a.pvm", "PVM\n2 2 2\n2\n" + bytes)});
    EXPECT_EQ(readFrame(*source, 0), (std::vector<float>{1, 256, 65535, 32768, 0, 0x1234, 255, 65280}));
}

TEST(Pvm, SpacingIsTaken) {
    for (const char* magic : {"PVM", "PVM2"}) {
        const auto source =
            open({writeFile("a.pvm", std::string(magic) + "\n2 2 2\n1 0.5 2.5e0\n1\n" + ramp(8))});
        EXPECT_EQ(source->description().lattice.axes[1].coordinates, (std::vector<double>{0, 0.5}));
        EXPECT_EQ(source->description().lattice.axes[2].coordinates, (std::vector<double>{0, 2.5}));
        EXPECT_EQ(readFrame(*source, 0)[7], 7);
    }
}

TEST(Pvm, SequenceKeepsItsOrder) {
    const auto b = writeFile("b.pvm", "PVM\n2 2 2\n1\n" + ramp(8, 10));
    const auto a = writeFile("a.pvm", "PVM\n2 2 2\n1\n" + ramp(8, 20));
    const auto source = open({b, a});
    EXPECT_EQ(source->description().time.times, (std::vector<double>{0, 1}));
    EXPECT_EQ(readFrame(*source, 1)[0], 20);
    EXPECT_EQ(readFrame(*source, 0)[0], 10);
    EXPECT_EQ(source->description().provenance,
              b.filename().string() + " to " + a.filename().string() + ", PVM, 2 files");
    EXPECT_EQ(source->description().name, b.stem().string());
    EXPECT_EQ(open({b, a}, {"", {4, 6}})->description().time.times, (std::vector<double>{4, 6}));
    EXPECT_TRUE(failsWith([&] { open({b, a}, {"", {4}}); }, {"1 times for 2 key frames"}));
    EXPECT_TRUE(failsWith([&] { open({b, a}, {"", {4, 4}}); }, {"strictly increase", "index 1"}));
}

TEST(Pvm, FilesOfASequenceMustAgree) {
    const auto first = writeFile("first.pvm", "PVM\n2 2 2\n1\n" + ramp(8));
    const auto dims = writeFile("dims.pvm", "PVM\n2 2 3\n1\n" + ramp(12));
    const auto bytes = writeFile("bytes.pvm", "PVM\n2 2 2\n2\n" + ramp(16));
    const auto spacing = writeFile("spacing.pvm", "PVM\n2 2 2\n1 1 2\n1\n" + ramp(8));
    EXPECT_TRUE(failsWith([&] { open({first, dims}); }, {"dimensions differ", "dims.pvm"}));
    EXPECT_TRUE(failsWith([&] { open({first, bytes}); }, {"bytes per sample differ", "bytes.pvm"}));
    EXPECT_TRUE(failsWith([&] { open({first, spacing}); }, {"spacing differs", "spacing.pvm"}));
}

TEST(Pvm, PayloadMustFitExactly) {
    EXPECT_TRUE(failsWith([] { open({writeFile("short.pvm", "PVM\n2 2 2\n1\n" + ramp(7))}); },
                          {"announces 8", "7 follow", "short.pvm"}));
    EXPECT_TRUE(failsWith([] { open({writeFile("long.pvm", "PVM\n2 2 2\n2\n" + ramp(17))}); },
                          {"announces 16", "17 follow", "long.pvm"}));
}

TEST(Pvm, FileThatShrinksLaterIsNoticed) {
    const auto path = writeFile("a.pvm", "PVM\n2 2 2\n1\n" + ramp(8));
    const auto source = open({path});
    std::filesystem::resize_file(path, 12);
    EXPECT_TRUE(failsWith([&] { readFrame(*source, 0); }, {"cannot be read", "a.pvm"}));
}

TEST(Pvm, BadHeadersAreRefused) {
    struct Case {
        const char* content;
        const char* says;
    };
    for (const Case& bad :
         {Case{"", "ends early"}, Case{"PVM", "ends early"}, Case{"CDF\n2 2 2\n1\n", "not a PVM file"},
          Case{"PVM3\n2 2 2\n1 1 1\n1\n", "version 3"}, Case{"DDS v3d\nxxxx", "compressed"},
          Case{"PVM\n2 2\n1\n", "three dimensions"}, Case{"PVM\n2 2 2 2\n1\n", "three dimensions"},
          Case{"PVM\n2 2 -2\n1\n", "three dimensions"}, Case{"PVM\n2 0 2\n1\n", "axis of 0"},
          Case{"PVM\n2 2 99999999\n1\n", "axis of 99999999"},
          Case{"PVM\n4294967296 4294967296 4294967296\n1\n", "axis of 4294967296"},
          Case{"PVM\n99999999999999999999 2 2\n1\n", "three dimensions"}, Case{"PVM\n2 2 2\n3\n", "1 or 2"},
          Case{"PVM\n2 2 2\none\n", "1 or 2"}, Case{"PVM\n2 2 2\n1 0 1\n1\n", "spacing"},
          Case{"PVM\n2 2 2\n1 nan 1\n1\n", "spacing"}, Case{"PVM\n2 2 2\n1", "ends early"}})
        EXPECT_TRUE(failsWith([&] { open({writeFile("bad.pvm", bad.content)}); }, {bad.says, "bad.pvm"}))
            << bad.content;
    EXPECT_TRUE(failsWith([] { open({scratchFile("absent.pvm")}); }, {"no such file", "absent.pvm"}));
    EXPECT_TRUE(failsWith([] { open({}); }, {"no files"}));
}

TEST(Pvm, VariableIsRefused) {
    const auto path = writeFile("a.pvm", "PVM\n2 2 2\n1\n" + ramp(8));
    EXPECT_TRUE(failsWith([&] { open({path}, {"qcloud", {}}); }, {"no variables", "qcloud"}));
}

}  // namespace

}  // namespace isoglass
