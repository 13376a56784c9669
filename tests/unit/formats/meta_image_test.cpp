#include "formats/medical_images.h"
#include "unit/formats/small_files.h"

#include <gtest/gtest.h>

namespace isoglass {

namespace {

using test::expectWorldValues;
using test::failsWith;
using test::hasNote;
using test::metaImageBytes;
using test::SmallArray;
using test::write;

class MetaImage : public testing::Test {
  protected:
    ScratchFolder folder_;

    std::filesystem::path file(const std::string& bytes, const std::string& name = "scan.mha") const {
        write(folder_ / name, bytes);
        return folder_ / name;
    }
};

TEST_F(MetaImage, EveryStepIsReadPlainAndCompressed) {
    for (const bool zlib : {false, true}) {
        const auto source = openMetaImage(file(metaImageBytes({}, "", zlib)), "");
        expectWorldValues(*source);
        EXPECT_EQ(source->description().time.times, (std::vector<double>{100, 100.5}));
        EXPECT_TRUE(source->knowsTimes());
    }
}

TEST_F(MetaImage, AnatomicalCoordinatesBecomeRightAnterior) {
    const auto source =
        openMetaImage(file(metaImageBytes({.frames = 1}, "AnatomicalOrientation = RAI\n")), "");
    const SeriesDescription& series = source->description();
    EXPECT_EQ(series.lattice.axes[0].coordinates, (std::vector<double>{0, -1, -2, -3, -4}));
    EXPECT_FALSE(series.lattice.mirrored());
    EXPECT_TRUE(hasNote(series, "negated"));
    EXPECT_FALSE(
        hasNote(openMetaImage(file(metaImageBytes({.frames = 1}, "AnatomicalOrientation = ???\n")), "")
                    ->description(),
                "negated"));
}

TEST_F(MetaImage, DataFilesLieBesideTheHeader) {
    const SmallArray array{.frames = 1};
    const std::string samples = test::packed<std::int16_t>(array.values(), true);
    const std::string header =
        "NDims = 3\nDimSize = 5 4 3\nElementType = MET_SHORT\nElementByteOrderMSB = True\n";
    file("junk" + samples, "all.raw");
    for (int i = 0; i < 3; ++i)
        file(samples.substr(static_cast<std::size_t>(i) * 40, 40), "s" + std::to_string(3 - i));
    for (const char* data :
         {"HeaderSize = -1\nElementDataFile = all.raw\n", "HeaderSize = 4\nElementDataFile = all.raw\n",
          "ElementDataFile = s%d 3 1 -1\n", "ElementDataFile = LIST\ns3\ns2\ns1\n"})
        expectWorldValues(*openMetaImage(file(header + data, "scan.mhd"), ""), 1);
    EXPECT_TRUE(failsWith([&] { openMetaImage(file(header + "ElementDataFile = all.raw", "scan.mhd"), ""); },
                          {"announces 120", "124 follow"}));
    EXPECT_TRUE(
        failsWith([&] { openMetaImage(file(header + "ElementDataFile = s%d 1 0\n", "scan.mhd"), ""); },
                  {"make no sense"}));
}

TEST_F(MetaImage, BadHeadersAreRefused) {
    const std::string good = metaImageBytes({.frames = 1});
    struct Case {
        const char* from;
        const char* to;
        const char* says;
    };
    for (const Case& bad :
         {Case{"NDims = 3", "NDims = 2", "3 or 4"}, Case{"NDims = 3\n", "", "\"ndims\" is missing"},
          Case{"MET_SHORT", "MET_STRING", "no plain number"},
          Case{"DimSize = 5 4 3", "DimSize = 5 4 1000000", "announces"},
          Case{"DimSize = 5 4 3", "DimSize = 1000000 1000000 1000000", "2^34"},
          Case{"DimSize = 5 4 3", "DimSize = 5 4", "not 3 whole"},
          Case{"DimSize = 5 4 3", "DimSize = 5 4 2", "announces 80"},
          Case{"BinaryData = True", "BinaryData = False", "as text"},
          Case{"BinaryData = True", "BinaryData = maybe", "neither"},
          Case{"BinaryData = True", "ElementNumberOfChannels = 3", "3 channels"},
          Case{"Offset = 0 0 0", "Offset = 0 0 x", "not 3 numbers"},
          Case{"ElementSpacing = 1 1 1", "ElementSpacing = 1 0 1", "makes no sense"},
          Case{"ElementDataFile = LOCAL", "", "ElementDataFile"},
          Case{"LOCAL", "absent.raw", "absent.raw"}}) {
        std::string bytes = good;
        bytes.replace(bytes.find(bad.from), std::string(bad.from).size(), bad.to);
        EXPECT_TRUE(failsWith([&] { openMetaImage(file(bytes), ""); }, {bad.says})) << bad.to;
    }
    const std::string packed = metaImageBytes({.frames = 1}, "", true);
    const auto source = openMetaImage(file(packed.substr(0, packed.size() - 6)), "");
    EXPECT_TRUE(failsWith([&] { test::readFrame(*source, 0); }, {"damaged", "scan.mha"}));
}

}  // namespace

}  // namespace isoglass
