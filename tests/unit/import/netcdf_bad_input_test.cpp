#include "unit/import/import_check.h"
#include "unit/import/netcdf_writer.h"
#include "volume/netcdf_classic.h"

#include <gtest/gtest.h>

#include <array>
#include <fstream>
#include <limits>

namespace isoglass {

namespace {

using test::failsWith;
using test::NetcdfWriter;
using test::readFrame;
using test::scratchFile;
using test::writeStandardVolume;

constexpr std::array kClassicFormats{0, NC_64BIT_OFFSET, NC_64BIT_DATA};

void open(const std::filesystem::path& path, const std::string& variable = {}) {
    openNetcdf(path, {variable, {}});
}

TEST(NetcdfBadInput, AbsentFileIsNamed) {
    EXPECT_TRUE(failsWith([] { open(scratchFile("absent.nc")); }, {"no such file", "absent.nc"}));
    EXPECT_TRUE(failsWith([] { open(testing::TempDir()); }, {"no such file"}));
}

TEST(NetcdfBadInput, AddressesAreNotFollowed) {
    EXPECT_TRUE(failsWith([] { open("http://localhost:1/data.nc"); }, {"no such file"}));
}

TEST(NetcdfBadInput, OtherFormatsAreRefused) {
    for (const char* content : {"", "C", "CDF", "CDF\x07", "PVM\n2 2 2\n1\n12345678", "\x89HDF\r\n\x1a\n"}) {
        std::ofstream(scratchFile("a.nc"), std::ios::binary) << content;
        EXPECT_TRUE(failsWith([] { open(scratchFile("a.nc")); }, {"a.nc"})) << content;
    }
}

/// The library copies a name of any length into a buffer for 256 bytes.
TEST(NetcdfBadInput, NamesTooLongForTheLibraryAreRefused) {
    for (const std::size_t length : {252, 260, 4000}) {
        const auto word = [](std::size_t value) {
            return std::string{static_cast<char>(value >> 24), static_cast<char>(value >> 16),
                               static_cast<char>(value >> 8), static_cast<char>(value)};
        };
        std::ofstream(scratchFile("a.nc"), std::ios::binary)
            << "CDF\x01" << word(0) << word(10) << word(1) << word(length) << std::string(length, 'd') << word(3)
            << std::string(16, '\0');
        const char* refusal = length > 256 ? "header ends early or contradicts itself" : "no variable";
        EXPECT_TRUE(failsWith([] { open(scratchFile("a.nc")); }, {refusal, "a.nc"})) << length;
    }
}

TEST(NetcdfBadInput, ClassicFileCutAnywhereIsRefused) {
    for (const int format : kClassicFormats) {
        NetcdfWriter writer(scratchFile("a.nc"), format);
        const auto path = writeStandardVolume(writer).close();
        ASSERT_NO_THROW(open(path));
        ASSERT_EQ(classicNetcdfSize(path), std::filesystem::file_size(path));
        for (std::uintmax_t size = std::filesystem::file_size(path); size-- > 0;) {
            std::filesystem::resize_file(path, size);
            ASSERT_TRUE(failsWith([&] { open(path); }, {"a.nc"}))
                << "format " << format << ", " << size << " bytes";
        }
    }
}

/// A file with three records of F, which is the only record variable where `alone`.
std::filesystem::path writeRecords(int format, bool alone) {
    NetcdfWriter writer(scratchFile("a.nc"), format);
    writer.dimension("time", NC_UNLIMITED).dimension("z", 3).dimension("y", 2).dimension("x", 3);
    writer.variable("F", NC_BYTE, {"time", "z", "y", "x"});
    if (!alone) writer.variable("time", NC_DOUBLE, {"time"});
    EXPECT_EQ(nc_enddef(writer.id()), NC_NOERR);
    const std::array<std::size_t, 4> start{0, 0, 0, 0};
    const std::array<std::size_t, 4> count{3, 3, 2, 3};
    const std::vector<signed char> samples(54, 1);
    const std::vector<double> times{1, 2, 3};
    EXPECT_EQ(nc_put_vara_schar(writer.id(), 0, start.data(), count.data(), samples.data()), NC_NOERR);
    if (!alone) {
        EXPECT_EQ(nc_put_vara_double(writer.id(), 1, start.data(), count.data(), times.data()), NC_NOERR);
    }
    return writer.close();
}

TEST(NetcdfBadInput, RecordsCutOffAreNoticed) {
    for (const int format : kClassicFormats)
        for (const bool alone : {true, false}) {
            SCOPED_TRACE(testing::Message() << "format " << format << ", alone " << alone);
            // Records of 18 bytes: padded to 20 unless F is the only record variable.
            const auto path = writeRecords(format, alone);
            ASSERT_NO_THROW(open(path));
            const std::uintmax_t promised = *classicNetcdfSize(path);
            EXPECT_LE(std::filesystem::file_size(path) - promised, 3u) << "more than padding to four bytes";
            std::filesystem::resize_file(path, promised - 1);
            EXPECT_TRUE(failsWith([&] { open(path); }, {"cut off"}));
        }
}

TEST(NetcdfBadInput, Netcdf4FileCutOffIsRefused) {
    NetcdfWriter writer(scratchFile("a.nc"));
    const auto path = writeStandardVolume(writer).close();
    const std::uintmax_t whole = std::filesystem::file_size(path);
    for (const std::uintmax_t size : {whole - 1, whole / 2, whole / 10, std::uintmax_t{9}}) {
        std::filesystem::resize_file(path, size);
        EXPECT_TRUE(failsWith([&] { open(path); }, {"cannot be read as NetCDF", "a.nc"})) << size;
    }
}

TEST(NetcdfBadInput, UnknownVariableListsTheKnownOnes) {
    NetcdfWriter writer(scratchFile("a.nc"));
    const auto path = writeStandardVolume(writer).variable("ground", NC_FLOAT, {"lat", "lon"}).close();
    EXPECT_TRUE(failsWith([&] { open(path, "Q"); }, {"no variable \"Q\"", "T(time, lev, lat, lon)"}));
    EXPECT_TRUE(failsWith([&] { open(path, "ground"); },
                          {"no volume", "ground(lat, lon)", "T(time, lev, lat, lon)"}));
}

TEST(NetcdfBadInput, FileWithoutVolumeListsItsVariables) {
    NetcdfWriter writer(scratchFile("a.nc"));
    writer.dimension("lat", 3).dimension("lon", 4).variable("ground", NC_FLOAT, {"lat", "lon"});
    const auto path = writer.close();
    EXPECT_TRUE(failsWith([&] { open(path); }, {"three axes", "ground(lat, lon)"}));
}

TEST(NetcdfBadInput, CoordinatesMustBeStrictlyMonotonic) {
    struct Case {
        std::vector<double> longitudes;
        const char* index;
    };
    for (const Case& bad : {Case{{0, 10, 10, 20}, "index 2"}, Case{{0, 10, 20, 15}, "index 3"},
                            Case{{5, 5, 6, 7}, "index 1"}, Case{{9, 8, 8.5, 7}, "index 2"}}) {
        NetcdfWriter writer(scratchFile("a.nc"));
        const auto path = writeStandardVolume(writer).values("lon", bad.longitudes).close();
        EXPECT_TRUE(failsWith([&] { open(path); }, {"strictly", bad.index, "variable lon"}));
    }
}

TEST(NetcdfBadInput, CoordinatesMustBeFinite) {
    for (const double bad :
         {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
        NetcdfWriter writer(scratchFile("a.nc"));
        const auto path = writeStandardVolume(writer).values("lat", {-1, 0, bad}).close();
        EXPECT_TRUE(failsWith([&] { open(path); }, {"not finite", "index 2", "variable lat"}));
    }
}

TEST(NetcdfBadInput, TimesMustBeFinite) {
    NetcdfWriter writer(scratchFile("a.nc"));
    const auto path =
        writeStandardVolume(writer).values("time", {0, std::numeric_limits<double>::quiet_NaN()}).close();
    EXPECT_TRUE(failsWith([&] { open(path); }, {"not finite", "index 1", "variable time"}));
}

TEST(NetcdfBadInput, SeriesWithoutStepsIsRefused) {
    NetcdfWriter writer(scratchFile("a.nc"));
    writer.dimension("time", NC_UNLIMITED).dimension("z", 2).dimension("y", 2).dimension("x", 2);
    const auto path = writer.variable("F", NC_FLOAT, {"time", "z", "y", "x"}).close();
    EXPECT_TRUE(failsWith([&] { open(path); }, {"no time steps", "variable F"}));
}

TEST(NetcdfBadInput, SizesThatNoMemoryHoldsAreRefused) {
    // NetCDF-4 stores chunks only where samples were written, so these files are tiny.
    const auto huge = [](std::size_t z, std::size_t y, std::size_t x, std::size_t times = 1) {
        NetcdfWriter writer(scratchFile("a.nc"));
        writer.dimension("time", times).dimension("z", z).dimension("y", y).dimension("x", x);
        writer.variable("F", NC_BYTE, {"time", "z", "y", "x"});
        const std::array<std::size_t, 4> chunk{1, 1, 1, 16};
        EXPECT_EQ(nc_def_var_chunking(writer.id(), 0, NC_CHUNKED, chunk.data()), NC_NOERR);
        return writer.close();
    };
    EXPECT_TRUE(failsWith([&] { open(huge(16, 16, std::size_t{1} << 40)); }, {"too large", "axis x"}));
    EXPECT_TRUE(failsWith([&] { open(huge(1 << 20, 1 << 20, 1 << 20)); }, {"too large", "variable F"}));
    EXPECT_TRUE(
        failsWith([&] { open(huge(16, 16, 16, std::size_t{1} << 40)); }, {"time steps are too many"}));
}

}  // namespace

}  // namespace isoglass
