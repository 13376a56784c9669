#include "formats/medical_images.h"
#include "unit/formats/small_files.h"

#include <gtest/gtest.h>

namespace isoglass {

namespace {

using test::expectWorldValues;
using test::failsWith;
using test::hasNote;
using test::nrrdBytes;
using test::SmallArray;
using test::write;

class Nrrd : public testing::Test {
  protected:
    ScratchFolder folder_;

    std::filesystem::path file(const std::string& bytes, const std::string& name = "scan.nrrd") const {
        write(folder_ / name, bytes);
        return folder_ / name;
    }
    SeriesDescription describe(const std::string& bytes) const {
        return openNrrd(file(bytes), "")->description();
    }
};

TEST_F(Nrrd, RawAndGzipAreRead) {
    for (const bool gzip : {false, true}) {
        const auto source = openNrrd(
            file(nrrdBytes({}, "spacings: 1 1 1 0.5\nkinds: domain domain domain time\n", gzip)), "");
        expectWorldValues(*source);
        EXPECT_EQ(source->description().time.times, (std::vector<double>{0, 0.5}));
    }
}

TEST_F(Nrrd, SpacingAndLimitsPlaceTheSamples) {
    const SmallArray array{.frames = 1};
    EXPECT_EQ(
        describe(nrrdBytes(array, "spacings: 2 1 nan\naxis mins: 5 nan 0\n")).lattice.axes[0].coordinates,
        (std::vector<double>{5, 7, 9, 11, 13}));
    // 4 cells of width 2 from 0 to 8 have their middles at 1, 3, 5, 7; nodes are at the limits.
    EXPECT_EQ(describe(nrrdBytes(array, "centers: cell cell node\naxis mins: nan 0 0\naxis maxs: nan 8 8\n"))
                  .lattice.axes[1]
                  .coordinates,
              (std::vector<double>{1, 3, 5, 7}));
    EXPECT_EQ(describe(nrrdBytes(array, "centers: cell cell node\naxis mins: nan 0 0\naxis maxs: nan 8 8\n"))
                  .lattice.axes[2]
                  .coordinates,
              (std::vector<double>{0, 4, 8}));
}

TEST_F(Nrrd, LeftPosteriorBecomesRightAnterior) {
    const SmallArray array{.frames = 1};
    const std::string directions = test::nrrdDirections({.frames = 1, .place = {{1, 2, 3}}});
    const SeriesDescription series = describe(nrrdBytes(
        array, "space: left-posterior-superior\n" + directions + "space units: \"mm\" \"mm\" \"mm\"\n"));
    EXPECT_EQ(series.lattice.axes[0].coordinates, (std::vector<double>{-1, -2, -3, -4, -5}));
    EXPECT_EQ(series.lattice.axes[1].coordinates[3], -5);
    EXPECT_EQ(series.lattice.axes[2].coordinates[2], 5);
    EXPECT_EQ(series.lattice.axes[2].units, "mm");
    EXPECT_FALSE(series.lattice.mirrored());
    EXPECT_TRUE(hasNote(series, "negated"));
}

/// As 3D Slicer writes time series: the axis of time is the fastest.
TEST_F(Nrrd, TimeMayBeAnyAxis) {
    const SmallArray array;
    const std::vector<float> values = array.values();
    const std::uint64_t volume = 5 * 4 * 3;
    for (std::size_t position = 0; position < 3; ++position) {
        std::uint64_t inner = 1;
        for (std::size_t i = 0; i < position; ++i) inner *= array.lengths[i];
        std::vector<float> moved;
        for (std::uint64_t outer = 0; outer < volume / inner; ++outer)
            for (std::uint64_t t = 0; t < 2; ++t)
                for (std::uint64_t i = 0; i < inner; ++i)
                    moved.push_back(values[t * volume + outer * inner + i]);
        std::vector<std::string> sizes = {"5", "4", "3"}, kinds(3, "domain"),
                                 directions = {"(1,0,0)", "(0,1,0)", "(0,0,1)"};
        const auto place = static_cast<std::ptrdiff_t>(position);
        sizes.insert(sizes.begin() + place, "2");
        kinds.insert(kinds.begin() + place, "list");
        directions.insert(directions.begin() + place, "none");
        const auto joined = [](const std::vector<std::string>& words) {
            std::string text;
            for (const std::string& word : words) text += " " + word;
            return text + "\n";
        };
        const std::string header =
            "NRRD0004\ntype: float\nendian: big\ndimension: 4\nsizes:" + joined(sizes) +
            "kinds:" + joined(kinds) + "space: RAS\nspace directions:" + joined(directions) +
            "encoding: raw\n\n";
        expectWorldValues(*openNrrd(file(header + test::packed<float>(moved, true)), ""));
    }
}

TEST_F(Nrrd, DataFilesLieBesideTheHeader) {
    const SmallArray array{.frames = 1};
    const std::string samples = test::packed<std::int16_t>(array.values());
    const std::string header =
        "NRRD0004\ntype: int16\nendian: little\ndimension: 3\nsizes: 5 4 3\nencoding: raw\n";
    file(samples, "all.raw");
    for (int i = 0; i < 3; ++i)
        file(samples.substr(static_cast<std::size_t>(i) * 40, 40), "s0" + std::to_string(i + 1));
    for (const char* data :
         {"data file: all.raw\n", "datafile: s%02d 1 3 1\n", "data file: LIST\ns01\ns02\ns03\n",
          "data file: LIST\ns01\ns02\ns03", "data file: all.raw"})
        expectWorldValues(*openNrrd(file(header + data, "scan.nhdr"), ""), 1);
    file("junk" + samples, "all.raw");
    expectWorldValues(*openNrrd(file(header + "byte skip: 4\ndata file: all.raw\n", "scan.nhdr"), ""), 1);
    expectWorldValues(*openNrrd(file(header + "byte skip: -1\ndata file: all.raw\n", "scan.nhdr"), ""), 1);
    EXPECT_TRUE(failsWith([&] { openNrrd(file(header + "data file: none.raw\n", "scan.nhdr"), ""); },
                          {"no such file", "none.raw"}));
    EXPECT_TRUE(
        failsWith([&] { openNrrd(file(header + "data file: s%02d 1 3000000000 1\n", "scan.nhdr"), ""); },
                  {"no numbers", "scan.nhdr"}));
    EXPECT_TRUE(
        failsWith([&] { openNrrd(file(header + "data file: s%02d 1 999999999 1\n", "scan.nhdr"), ""); },
                  {"make no sense", "scan.nhdr"}));
}

TEST_F(Nrrd, BadHeadersAreRefused) {
    const std::string good = nrrdBytes({.frames = 1}, "");
    struct Case {
        const char* from;
        const char* to;
        const char* says;
    };
    for (const Case& bad :
         {Case{"NRRD0005", "NRXD0005", "not a NRRD"},
          Case{"type: short", "type: block", "no plain number"},
          Case{"type: short\n", "", "\"type\" is missing"},
          Case{"endian: little\n", "", "\"endian\" is missing"},
          Case{"endian: little", "endian: middle", "neither"},
          Case{"dimension: 3", "dimension: 2", "3 or 4"},
          Case{"dimension: 3", "dimension: 4", "not 4 whole"},
          Case{"5 4 3", "5 4 -3", "not 3 whole"},
          Case{"5 4 3", "5 4 4", "announces 160"},
          Case{"5 4 3", "5 4 2", "announces 80"},
          Case{"5 4 3", "5 4 1", "axis of 1"},
          Case{"5 4 3", "900000 900000 900000", "2^34"},
          Case{"5 4 3", "99999999999 4 3", "axis of 99999999999"},
          Case{"5 4 3", "99999999999999999999999 4 3", "not 3 whole"},
          Case{"encoding: raw", "encoding: bzip2", "bzip2"},
          Case{"encoding: raw", "encoding: raw\nspacings: 0 1 1", "makes no sense"},
          Case{"encoding: raw", "encoding: raw\nspacings: 1 1", "2 values for 3"},
          Case{"encoding: raw", "encoding: raw\nencoding: raw", "twice"},
          Case{"encoding: raw", "encoding: raw\nspace directions: (1,0,0) (0,1,0)", "2 values"},
          Case{"encoding: raw", "encoding: raw\nspace directions: (1,0,0) (0,1,0) (0,0", "bracket"},
          Case{"encoding: raw", "encoding: raw\nspace directions: (1,0) (0,1,0) (0,0,1)", "2 components"},
          Case{"encoding: raw", "nonsense", "no field"}}) {
        std::string bytes = good;
        bytes.replace(bytes.find(bad.from), std::string(bad.from).size(), bad.to);
        EXPECT_TRUE(failsWith([&] { openNrrd(file(bytes), ""); }, {bad.says, "scan.nrrd"})) << bad.to;
    }
    const std::string series = nrrdBytes({}, "kinds: domain domain domain vector\n");
    EXPECT_TRUE(failsWith([&] { openNrrd(file(series), ""); }, {"kind \"vector\""}));
    EXPECT_TRUE(
        failsWith([&] { openNrrd(file(good.substr(0, good.find("\n\n") + 1)), ""); }, {"ends early"}));
    EXPECT_TRUE(
        failsWith([&] { openNrrd(folder_ / "absent.nrrd", ""); }, {"cannot be opened", "absent.nrrd"}));
}

}  // namespace

}  // namespace isoglass
