#include "formats/medical_images.h"
#include "unit/formats/small_files.h"

#include <gtest/gtest.h>

namespace isoglass {

namespace {

using test::failsWith;
using test::SmallArray;
using test::write;

class Sequence : public testing::Test {
  protected:
    ScratchFolder folder_;

    /// A NIfTI file whose first sample is `value`.
    std::filesystem::path file(const std::string& name, std::int16_t value,
                               const SmallArray& array = {.frames = 1}) const {
        std::string bytes = test::niftiBytes(array);
        test::put(bytes, 352, value);
        write(folder_ / name, bytes);
        return folder_ / name;
    }
    std::unique_ptr<FrameSource> open(const std::vector<std::filesystem::path>& files,
                                      const ImportOptions& options = {},
                                      const std::vector<double>& times = {}) const {
        return openSequence(files, openNifti, options, "NIfTI", times);
    }
};

TEST_F(Sequence, FilesFollowEachOtherAndStepsCount) {
    const auto source = open({file("a.nii", 100), file("b.nii", 200, {.frames = 2}), file("c.nii", 300)});
    EXPECT_EQ(source->description().time.times, (std::vector<double>{0, 1, 2, 3}));
    EXPECT_EQ(test::readFrame(*source, 3)[0], 300);
    EXPECT_EQ(test::readFrame(*source, 1)[0], 200);
    EXPECT_EQ(test::readFrame(*source, 2)[0], 7);
    EXPECT_EQ(test::readFrame(*source, 0)[0], 100);
    EXPECT_NE(source->description().provenance.find("a.nii to c.nii, NIfTI, 3 files"), std::string::npos);
}

TEST_F(Sequence, TimesOfTheCommandLineOverruleThoseOfAnIndexAndOfTheFiles) {
    const auto one = file("one.nii", 1, {.frames = 2});
    EXPECT_EQ(open({one})->description().time.times, (std::vector<double>{0, 2.5}));
    EXPECT_EQ(open({one}, {}, {3, 4})->description().time.times, (std::vector<double>{3, 4}));
    EXPECT_EQ(open({one}, {"", {5, 9}}, {3, 4})->description().time.times, (std::vector<double>{5, 9}));
    EXPECT_TRUE(failsWith([&] { open({one}, {"", {5}}); }, {"1 times for 2", "--times"}));
    EXPECT_TRUE(failsWith([&] { open({one}, {"", {5, 5}}); }, {"strictly increase", "index 1"}));
    EXPECT_TRUE(failsWith([&] { open({one}, {}, {4, 3}); }, {"strictly increase", "index file"}));
    // Both files say that they begin at 0.
    EXPECT_TRUE(failsWith(
        [&] {
            open({one, file("two.nii", 2, {.frames = 2})});
        },
        {"strictly increase", "in the files"}));
}

TEST_F(Sequence, FilesMustAgree) {
    const auto first = file("first.nii", 1);
    EXPECT_TRUE(failsWith(
        [&] {
            open({first, file("dims.nii", 1, {.lengths = {5, 4, 4}, .frames = 1})});
        },
        {"dimensions differ", "dims.nii"}));
    EXPECT_TRUE(failsWith(
        [&] {
            open({first, file("moved.nii", 1, {.frames = 1, .place = {{1, 0, 0}}})});
        },
        {"places of the samples differ", "moved.nii"}));
    EXPECT_TRUE(failsWith([&] { open({first, folder_ / "absent.nii"}); }, {"no such file", "absent.nii"}));
    EXPECT_TRUE(failsWith([&] { open({}); }, {"no files"}));
}

TEST_F(Sequence, FileThatChangesLaterIsNoticed) {
    const auto first = file("first.nii", 1), second = file("second.nii", 2);
    const auto source = open({first, second});
    file("first.nii", 1, {.lengths = {5, 4, 4}, .frames = 1});
    EXPECT_TRUE(failsWith([&] { test::readFrame(*source, 0); }, {"dimensions differ", "first.nii"}));
}

}  // namespace

}  // namespace isoglass
