#include "formats/medical_images.h"
#include "unit/formats/small_files.h"

#include <gtest/gtest.h>

namespace isoglass {

namespace {

using test::expectWorldValues;
using test::failsWith;
using test::hasNote;
using test::niftiBytes;
using test::put;
using test::SmallArray;
using test::write;

class Nifti : public testing::Test {
  protected:
    ScratchFolder folder_;

    std::filesystem::path file(const std::string& bytes, const std::string& name = "scan.nii") const {
        write(folder_ / name, bytes);
        return folder_ / name;
    }
};

TEST_F(Nifti, EveryStepIsRead) {
    const auto source = openNifti(file(niftiBytes({.frames = 3})), "");
    expectWorldValues(*source, 3);
    const SeriesDescription& series = source->description();
    EXPECT_TRUE(source->knowsTimes());
    EXPECT_EQ(series.time.times, (std::vector<double>{0, 2.5, 5}));
    EXPECT_EQ(series.time.units, "s");
    EXPECT_EQ(series.lattice.axes[0].units, "mm");
    EXPECT_EQ(series.name, "scan");
}

TEST_F(Nifti, OffsetOfTheTimesCountsWhereTheStepIsNotLostInIt) {
    std::string bytes = niftiBytes({.frames = 2});
    constexpr std::size_t kOffset = 136;
    const auto times = [&](float offset) {
        put(bytes, kOffset, offset);
        return openNifti(file(bytes), "")->description().time.times;
    };
    EXPECT_EQ(times(-7), (std::vector<double>{-7, -4.5}));
    for (const float useless : {std::nanf(""), std::numeric_limits<float>::infinity(), -1e30f})
        EXPECT_EQ(times(useless), (std::vector<double>{0, 2.5})) << useless;
}

TEST_F(Nifti, EitherByteOrderAndEitherPackingIsRead) {
    const SmallArray array;
    for (const bool bigEndian : {false, true}) {
        const std::string bytes = niftiBytes(array, bigEndian);
        expectWorldValues(*openNifti(file(bytes), ""));
        expectWorldValues(*openNifti(file(test::deflated(bytes), "scan.nii.gz"), ""));
    }
}

TEST_F(Nifti, StepsOfACompressedFileAreReadInAnyOrder) {
    const auto source = openNifti(file(test::deflated(niftiBytes({.frames = 3})), "scan.nii.gz"), "");
    const auto last = test::readFrame(*source, 2), first = test::readFrame(*source, 0);
    EXPECT_EQ(first[0], 0);
    EXPECT_EQ(last[0], 14);
}

TEST_F(Nifti, PairOfHeaderAndSamplesIsRead) {
    std::string header = niftiBytes({});
    const std::string samples = header.substr(352);
    header.resize(348);
    header.replace(344, 3, "ni1");
    put(header, 108, 0.0f);
    file(samples, "scan.img");
    expectWorldValues(*openNifti(file(header, "scan.hdr"), ""));
}

TEST_F(Nifti, SlopeAndInterceptAreApplied) {
    std::string bytes = niftiBytes({.frames = 1});
    put(bytes, 112, 0.5f);
    put(bytes, 116, -3.0f);
    const auto samples = test::readFrame(*openNifti(file(bytes), ""), 0);
    EXPECT_EQ(samples[1], 0.5f - 3);
    EXPECT_EQ(samples[5], 5 - 3);
}

// nifti1.h: a half turn about z (b = c = 0, d = 1) with qfac -1 gives steps -x, -y, -z.
TEST_F(Nifti, QformPlacesWhereThereIsNoSform) {
    std::string bytes = niftiBytes({.frames = 1});
    put(bytes, 254, std::int16_t{0});
    put(bytes, 252, std::int16_t{1});
    put(bytes, 76, -1.0f);
    put(bytes, 80, 2.0f);
    put(bytes, 88, 3.0f);
    put(bytes, 264, 1.0f);
    put(bytes, 268, 10.0f);
    const Lattice lattice = openNifti(file(bytes), "")->description().lattice;
    EXPECT_EQ(lattice.axes[0].coordinates, (std::vector<double>{10, 8, 6, 4, 2}));
    EXPECT_EQ(lattice.axes[1].coordinates, (std::vector<double>{0, -1, -2, -3}));
    EXPECT_EQ(lattice.axes[2].coordinates, (std::vector<double>{0, -3, -6}));
    EXPECT_TRUE(lattice.mirrored());
}

TEST_F(Nifti, SpacingAlonePlacesWithANote) {
    std::string bytes = niftiBytes({.frames = 1});
    put(bytes, 254, std::int16_t{0});
    put(bytes, 84, 0.5f);
    const auto source = openNifti(file(bytes), "");
    EXPECT_EQ(source->description().lattice.axes[1].coordinates, (std::vector<double>{0, 0.5, 1, 1.5}));
    EXPECT_TRUE(hasNote(source->description(), "neither sform nor qform"));
}

TEST_F(Nifti, ShearedSformGivesWayToTheQform) {
    std::string bytes = niftiBytes({.frames = 1});
    put(bytes, 284, 0.5f);
    EXPECT_TRUE(failsWith([&] { openNifti(file(bytes), ""); }, {"sheared", "scan.nii"}));
    put(bytes, 252, std::int16_t{1});
    EXPECT_TRUE(hasNote(openNifti(file(bytes), "")->description(), "qform places the volume"));
}

TEST_F(Nifti, BadHeadersAreRefused) {
    struct Case {
        std::size_t offset;
        int value;
        const char* says;
    };
    for (const Case& bad :
         {Case{0, 540, "NIfTI-2"}, Case{0, 77, "348 bytes"}, Case{40, 2, "2 dimensions"},
          Case{40, 99, "99 dimensions"}, Case{42, 0, "dimension 1 is 0"}, Case{44, -3, "dimension 2 is -3"},
          Case{44, 1, "axis of 1"}, Case{46, 30000, "announces"}, Case{48, 3, "announces 360"},
          Case{70, 128, "type 128"}, Case{70, 16, "announces 480"}}) {
        std::string bytes = niftiBytes({});
        put(bytes, bad.offset, static_cast<std::int16_t>(bad.value));
        EXPECT_TRUE(failsWith([&] { openNifti(file(bytes), ""); }, {bad.says, "scan.nii"})) << bad.offset;
    }
    std::string vectors = niftiBytes({});
    put(vectors, 40, std::int16_t{5});
    put(vectors, 50, std::int16_t{3});
    EXPECT_TRUE(failsWith([&] { openNifti(file(vectors), ""); }, {"vectors"}));
    std::string offset = niftiBytes({});
    put(offset, 108, 1e30f);
    EXPECT_TRUE(failsWith([&] { openNifti(file(offset), ""); }, {"cannot start"}));
    EXPECT_TRUE(failsWith([&] { openNifti(file(niftiBytes({}).replace(344, 3, "abc")), ""); }, {"magic"}));
    EXPECT_TRUE(failsWith([&] { openNifti(folder_ / "absent.nii", ""); }, {"no such file", "absent.nii"}));
    EXPECT_TRUE(failsWith([&] { openNifti(file(niftiBytes({})), "T1"); }, {"no variables", "T1"}));
}

TEST_F(Nifti, PayloadMustFitExactly) {
    const std::string bytes = niftiBytes({});
    EXPECT_TRUE(failsWith([&] { openNifti(file(bytes + "x"), ""); }, {"announces 240", "241 follow"}));
    EXPECT_TRUE(
        failsWith([&] { openNifti(file(bytes.substr(0, 591)), ""); }, {"announces 240", "239 follow"}));
    const auto longer = openNifti(file(test::deflated(bytes + "x"), "long.nii.gz"), "");
    test::readFrame(*longer, 0);
    EXPECT_TRUE(failsWith([&] { test::readFrame(*longer, 1); }, {"announces 240", "more follow"}));
    const auto shorter = openNifti(file(test::deflated(bytes.substr(0, 591)), "short.nii.gz"), "");
    EXPECT_TRUE(failsWith([&] { test::readFrame(*shorter, 1); }, {"announces 240", "239 follow"}));
}

}  // namespace

}  // namespace isoglass
