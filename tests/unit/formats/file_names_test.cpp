#include "formats/file_names.h"

#include "unit/import/import_check.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace isoglass {

namespace {

using test::failsWith;
using Paths = std::vector<std::filesystem::path>;

TEST(FileNames, NumbersAreOrderedByValue) {
    Paths names = {"t10.vti", "t9.vti", "t1.vti", "t010.vti", "s2", "t1.2", "t99999999999999999999999", "t"};
    std::ranges::sort(names, naturalLess);
    EXPECT_EQ(names, (Paths{"s2", "t", "t1.2", "t1.vti", "t9.vti", "t010.vti", "t10.vti",
                            "t99999999999999999999999"}));
    for (const auto& a : names)
        for (const auto& b : names) EXPECT_FALSE(naturalLess(a, b) && naturalLess(b, a)) << a << b;
}

TEST(FileNames, TheNumberThatTellsThemApartIsTheTime) {
    EXPECT_EQ(numbersInNames(Paths{"/d3/a_1.vti", "/d4/a_10.vti"}), (std::vector<double>{1, 10}));
    // Twice the same number is no contradiction; constant ones do not count.
    EXPECT_EQ(numbersInNames(Paths{"030_density_030_064_2.0.vti", "031_density_031_064_2.0.vti"}),
              (std::vector<double>{30, 31}));
    EXPECT_EQ(numbersInNames(Paths{"t0.25.nii.gz", "t0.5.nii.gz"}), (std::vector<double>{0.25, 0.5}));
    EXPECT_EQ(numbersInNames(Paths{"quarter.9", "quarter.10"}), (std::vector<double>{9, 10}));
    EXPECT_EQ(numbersInNames(Paths{"run2_frame17.vdb"}), std::vector<double>{17});
}

TEST(FileNames, WhatIsNotClearIsRefused) {
    EXPECT_TRUE(failsWith([] { numbersInNames(Paths{"a.vti"}); }, {"no number", "a.vti"}));
    EXPECT_TRUE(failsWith([] { numbersInNames(Paths{"a1_2.vti", "a2_3.vti"}); }, {"several numbers"}));
    EXPECT_TRUE(failsWith([] { numbersInNames(Paths{"a1.vti", "b1.vti"}); }, {"no number differs"}));
    EXPECT_TRUE(failsWith([] { numbersInNames(Paths{"a1.vti", "a1_2.vti"}); }, {"2 numbers", "a1_2.vti"}));
}

}  // namespace

}  // namespace isoglass
