#include "formats/medical_images.h"
#include "unit/formats/small_files.h"

#include <gtest/gtest.h>

namespace isoglass {

namespace {

using test::failsWith;
using test::SmallArray;
using test::write;

const SmallArray kArray{.frames = 1};

TEST(Slc, PlainSlicesAndRunLengthsAreRead) {
    const ScratchFolder folder;
    for (const bool runs : {false, true}) {
        write(folder / "a.slc", test::slcBytes(kArray, runs));
        test::expectWorldValues(*openSlc(folder / "a.slc", ""), 1);
    }
}

TEST(Slc, DamageIsRefused) {
    const ScratchFolder folder;
    const auto open = [&](const std::string& bytes) {
        write(folder / "a.slc", bytes);
        openSlc(folder / "a.slc", "");
    };
    const std::string good = test::slcBytes(kArray, true);
    const auto changed = [&](const std::string& from, const std::string& to) {
        return std::string(good).replace(good.find(from), from.size(), to);
    };
    EXPECT_TRUE(failsWith([&] { open(changed("11111", "11112")); }, {"not an SLC", "a.slc"}));
    EXPECT_TRUE(failsWith([&] { open(changed("5 4 3 8", "5 4 3 16")); }, {"16 bits"}));
    EXPECT_TRUE(failsWith([&] { open(changed("5 4 3 8", "5 4 1 8")); }, {"axis of 1"}));
    EXPECT_TRUE(failsWith([&] { open(changed("5 4 3 8", "900000 900000 9000 8")); }, {"2^34"}));
    EXPECT_TRUE(failsWith([&] { open(changed("5 4 3 8", "9000 900 3 8")); }, {"announces 24300000"}));
    EXPECT_TRUE(failsWith([&] { open(changed("5 4 3 8", "5 4 2 8")); }, {"bytes follow"}));
    EXPECT_TRUE(failsWith([&] { open(changed("5 4 3 8", "5 5 3 8")); }, {"fewer samples"}));
    EXPECT_TRUE(failsWith([&] { open(changed("5 4 3 8", "5 3 3 8")); }, {"more samples"}));
    EXPECT_TRUE(failsWith([&] { open(changed("1.0 1.0 1.0", "1.0 0 1.0")); }, {"positive"}));
    EXPECT_TRUE(failsWith([&] { open(changed("2 1 X", "2 1 Y")); }, {"mark X"}));
    EXPECT_TRUE(failsWith([&] { open(changed("2 1 X", "90000 90000 X")); }, {"announced"}));
    EXPECT_TRUE(failsWith([&] { open(changed("6 0 1", "6 0 2")); }, {"compression 2"}));
    EXPECT_TRUE(failsWith([&] { open(good.substr(0, good.size() - 3)); }, {"announced"}));
    EXPECT_TRUE(failsWith([&] { open("11111\n5 4"); }, {"ends early"}));
}

}  // namespace

}  // namespace isoglass
