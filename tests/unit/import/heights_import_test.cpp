#include "unit/import/import_check.h"
#include "unit/import/netcdf_writer.h"
#include "volume/series_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

namespace isoglass {
namespace {

using test::failsWith;
using test::hasNote;
using test::NetcdfWriter;
using test::readFrame;
using test::scratchFile;

constexpr double kFill = 9e36;
constexpr int kNx = 4;
constexpr int kNy = 3;
constexpr int kNz = 3;

using Formula = std::function<double(int t, int z, int y, int x)>;

double terrain(int t, int z, int y, int x) {
    return 100 * z + 10 * y + x + 5 * t;
}

/// T and heights H(time, z, y, x) in metres at cell centres, and P on the faces between levels.
std::filesystem::path writeFile(const Formula& height, const Formula& value = terrain) {
    NetcdfWriter writer(scratchFile("a.nc"));
    writer.dimension("time", 2).dimension("bottom_top", kNz).dimension("bottom_top_stag", kNz + 1);
    writer.dimension("y", kNy).dimension("x", kNx).dimension("other", 5);
    writer.coordinate("time", {0, 6}, "hours since 2000-01-01");
    const auto fill = [&](const std::string& name, const std::string& level, int levels,
                          const Formula& formula) {
        writer.variable(name, NC_FLOAT, {"time", level, "y", "x"})
            .numbers(name, "_FillValue", NC_FLOAT, {kFill});
        std::vector<double> samples;
        for (int t = 0; t < 2; ++t)
            for (int z = 0; z < levels; ++z)
                for (int y = 0; y < kNy; ++y)
                    for (int x = 0; x < kNx; ++x) samples.push_back(formula(t, z, y, x));
        writer.values(name, samples);
    };
    fill("T", "bottom_top", kNz, value);
    fill("H", "bottom_top", kNz, height);
    fill("P", "bottom_top_stag", kNz + 1, [&](int t, int z, int y, int x) { return 2 * height(t, z, y, x); });
    fill("Q", "other", 5, height);
    writer.text("H", "units", "m");
    return writer.close();
}

SeriesDescription write(const std::filesystem::path& file, const std::string& height) {
    const auto source = openNetcdf(file, {"T", {}, height});
    return writeSeries(*source, scratchFile("out.vdb"));
}

TEST(HeightsImport, AreReadAtTheCellCentres) {
    const auto path = writeFile(terrain);
    const auto source = openNetcdf(path, {"T", {}, "P/2 - 7"});
    const SeriesDescription& description = source->description();
    EXPECT_EQ(description.lattice.heights->name, "P/2 - 7");
    EXPECT_EQ(description.lattice.heights->units, "");
    // Terrain at the middle of the faces: half a level higher, means over 4 x 3 columns 11.5.
    EXPECT_EQ(description.lattice.axes[2].coordinates, (std::vector<double>{54.5, 154.5, 254.5}));
    EXPECT_EQ(description.lattice.axes[2].name, "bottom_top");
    EXPECT_TRUE(hasNote(description, "P is staggered along bottom_top"));
    EXPECT_TRUE(hasNote(description, "at the heights P/2 - 7"));
    EXPECT_FALSE(hasNote(description, "Axis bottom_top has no coordinates"));
    std::vector<float> heights(kNx * kNy * kNz);
    source->readHeights(1, heights);
    std::size_t i = 0;
    for (int z = 0; z < kNz; ++z)
        for (int y = 0; y < kNy; ++y)
            for (int x = 0; x < kNx; ++x, ++i) ASSERT_EQ(heights[i], terrain(1, z, y, x) + 50 - 7);
}

TEST(HeightsImport, ReachTheSeriesFile) {
    const SeriesDescription description = write(writeFile(terrain), "H");
    EXPECT_EQ(description.lattice.heights, (HeightField{"H", "m", 0, 228}));
    EXPECT_EQ(description.lattice.bounds()[1].z, 228);
    const SeriesFile file(scratchFile("out.vdb"));
    EXPECT_EQ(file.description().lattice.heights, description.lattice.heights);
    for (std::size_t t = 0; t < 2; ++t) {
        const auto frame = file.read(t);
        ASSERT_TRUE(frame->heights());
        EXPECT_EQ(frame->heights()->sample({3, 2, 1}), terrain(static_cast<int>(t), 1, 2, 3));
    }
}

TEST(HeightsImport, MayDescendWithTheIndex) {
    const SeriesDescription description =
        write(writeFile([](int t, int z, int y, int x) { return terrain(t, 5 - z, y, x); }), "H");
    EXPECT_TRUE(description.lattice.axes[2].descending());
    EXPECT_TRUE(description.lattice.mirrored());
}

TEST(HeightsImport, ColumnsMustBeMonotonic) {
    const auto kink = [](int t, int z, int y, int x) {
        return t == 1 && z == 2 && y == 1 && x == 3 ? 90 : terrain(t, z, y, x);
    };
    EXPECT_TRUE(
        failsWith([&] { write(writeFile(kink), "H"); },
                  {"strictly increase", "from 118 to 90", "heights H, key frame 1, sample x 3, y 1, z 1"}));
    const auto flat = [](int t, int z, int y, int x) {
        return terrain(t, z == 2 && x == 0 && y == 0 ? 1 : z, y, x);
    };
    EXPECT_TRUE(failsWith([&] { write(writeFile(flat), "H"); }, {"from 100 to 100", "x 0, y 0, z 1"}));
    const auto turns = [](int t, int z, int y, int x) { return terrain(0, t == 0 ? z : -z, y, x); };
    EXPECT_TRUE(failsWith([&] { write(writeFile(turns), "H"); }, {"strictly increase", "key frame 1"}));
    const auto level = [](int, int, int y, int x) { return 10.0 * y + x; };
    EXPECT_TRUE(failsWith([&] { write(writeFile(level), "H"); }, {"means are", "levels 0 and 1"}));
    EXPECT_FALSE(std::filesystem::exists(scratchFile("out.vdb")));
}

TEST(HeightsImport, MayBeMissingOnlyWhereTheFieldIs) {
    const auto hole = [](int t, int z, int y, int x) {
        return t == 1 && z == 1 && y == 2 && x == 0 ? kFill : terrain(t, z, y, x);
    };
    EXPECT_TRUE(failsWith([&] { write(writeFile(hole), "H"); },
                          {"has a value, but its height is missing", "key frame 1, sample x 0, y 2, z 1"}));
    EXPECT_NO_THROW(write(writeFile(hole, hole), "H"));
    const auto nothing = [](int t, int z, int y, int x) { return z == 1 ? kFill : terrain(t, z, y, x); };
    EXPECT_TRUE(
        failsWith([&] { write(writeFile(nothing, nothing), "H"); }, {"two successive levels", "0 and 1"}));
}

TEST(HeightsImport, MayNotLieCloserThanFloatsTell) {
    // 2^20 is a multiple of the steps of floats there, 1/8: the levels are a float apart.
    const auto high = [](int, int z, int, int) { return 0x1p20 + z / 8.0; };
    EXPECT_TRUE(failsWith([&] { write(writeFile(high), "H"); }, {"0.125 apart, too close", "subtract"}));
    EXPECT_NO_THROW(write(writeFile(high), "H - 1048576"));
}

TEST(HeightsImport, MustLieOnTheGridOfTheField) {
    const auto path = writeFile(terrain);
    EXPECT_TRUE(failsWith([&] { write(path, "Q"); }, {"dimension other (5)", "variable Q", "one grid"}));
    EXPECT_TRUE(failsWith([&] { write(path, "H + Z"); }, {"no variable \"Z\"", "--height, column 5"}));
    EXPECT_TRUE(failsWith([&] { write(path, "(H"); }, {"never closed", "--height, column 1"}));
}

}  // namespace
}  // namespace isoglass
