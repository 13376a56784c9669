#include "unit/import/import_check.h"
#include "unit/import/netcdf_writer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>

namespace isoglass {

namespace {

using test::NetcdfWriter;
using test::scratchFile;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

/// A file with one volume F of 2 x 2 x 2 values.
class Packed {
  public:
    explicit Packed(nc_type type) : writer_(scratchFile("packed.nc")) {
        writer_.dimension("z", 2).dimension("y", 2).dimension("x", 2).variable("F", type, {"z", "y", "x"});
    }

    Packed& number(const char* attribute, nc_type type, const std::vector<double>& values) {
        writer_.numbers("F", attribute, type, values);
        return *this;
    }

    Packed& text(const char* attribute, const char* value) {
        writer_.text("F", attribute, value);
        return *this;
    }

    NetcdfWriter& writer() { return writer_; }

    /// Fills the eight samples with `values` and as many of the first one as are left; returns what is read.
    std::vector<float> read(std::vector<double> values) {
        const std::size_t given = values.size();
        values.resize(8, values[0]);
        writer_.values("F", values);
        return readBack(given);
    }

    std::vector<float> readBack(std::size_t given) {
        std::vector<float> samples = test::readFrame(*openNetcdf(writer_.close(), {}), 0);
        samples.resize(given);
        return samples;
    }

  private:
    NetcdfWriter writer_;
};

/// Equal samples, where NaN equals NaN.
void expectSamples(const std::vector<float>& read, const std::vector<double>& expected) {
    ASSERT_EQ(read.size(), expected.size());
    for (std::size_t i = 0; i < read.size(); ++i) {
        if (std::isnan(expected[i]))
            EXPECT_TRUE(std::isnan(read[i])) << "sample " << i << " is " << read[i];
        else
            EXPECT_EQ(read[i], static_cast<float>(expected[i])) << "sample " << i;
    }
}

TEST(NetcdfPacking, EveryTypeIsRead) {
    for (const nc_type type : {NC_BYTE, NC_UBYTE, NC_SHORT, NC_USHORT, NC_INT, NC_UINT, NC_INT64, NC_UINT64,
                               NC_FLOAT, NC_DOUBLE}) {
        SCOPED_TRACE(type);
        expectSamples(Packed(type).read({0, 1, 100, 127}), {0, 1, 100, 127});
    }
}

TEST(NetcdfPacking, ScaleAndOffsetAreAppliedInDoublePrecision) {
    // 273.15 + 0.01 * 3000 rounds differently in single precision.
    const double sample = 3000 * 0.01 + 273.15;
    expectSamples(Packed(NC_SHORT)
                      .number("scale_factor", NC_DOUBLE, {0.01})
                      .number("add_offset", NC_DOUBLE, {273.15})
                      .read({3000, 0}),
                  {sample, 273.15});
    expectSamples(Packed(NC_SHORT).number("add_offset", NC_FLOAT, {5}).read({1}), {6});
    expectSamples(Packed(NC_FLOAT).number("scale_factor", NC_FLOAT, {2}).read({1.5}), {3});
}

TEST(NetcdfPacking, FillValueIsComparedBeforeUnpacking) {
    expectSamples(Packed(NC_SHORT)
                      .number("_FillValue", NC_SHORT, {-999})
                      .number("scale_factor", NC_DOUBLE, {0.5})
                      .read({-999, -1998, 4}),
                  {kNan, -999, 2});
}

TEST(NetcdfPacking, FillValueInSinglePrecisionIsFound) {
    expectSamples(Packed(NC_FLOAT)
                      .number("_FillValue", NC_FLOAT, {-1e34})
                      .number("missing_value", NC_DOUBLE, {-1e33})
                      .read({-1e34, -1e33, 7}),
                  {kNan, kNan, 7});
}

TEST(NetcdfPacking, DefaultFillValueIsMissing) {
    expectSamples(Packed(NC_FLOAT).read({NC_FILL_FLOAT, 1}), {kNan, 1});
    expectSamples(Packed(NC_SHORT).read({NC_FILL_SHORT, 1}), {kNan, 1});
    // Another fill value takes its place, and bytes have no default.
    expectSamples(Packed(NC_SHORT).number("_FillValue", NC_SHORT, {0}).read({NC_FILL_SHORT, 0}),
                  {NC_FILL_SHORT, kNan});
    expectSamples(Packed(NC_BYTE).read({NC_FILL_BYTE, 1}), {NC_FILL_BYTE, 1});
}

/// The library does not write such an attribute, and reads it beyond the end of what it was given room for.
TEST(NetcdfPacking, FillValuesOfAnotherTypeOrNumberAreFound) {
    const std::filesystem::path path = scratchFile("packed.nc");
    constexpr int kClassic = 0;
    NetcdfWriter writer(path, kClassic);
    writer.dimension("z", 2).dimension("y", 2).dimension("x", 2).variable("F", NC_SHORT, {"z", "y", "x"});
    writer.numbers("F", "_FillWorth", NC_DOUBLE, {-7, 12, 0.5}).values("F", {-7, 12, 0, 1, 2, 3, 4, 5}).close();
    std::ifstream file(path, std::ios::binary);
    std::string bytes{std::istreambuf_iterator<char>(file), {}};
    bytes.replace(bytes.find("_FillWorth"), 10, "_FillValue");
    std::ofstream(path, std::ios::binary) << bytes;
    expectSamples(test::readFrame(*openNetcdf(path, {}), 0), {kNan, kNan, 0, 1, 2, 3, 4, 5});
}

TEST(NetcdfPacking, EveryMissingValueOfAListIsMissing) {
    expectSamples(Packed(NC_INT).number("missing_value", NC_INT, {-1, -2, 77}).read({-1, -2, 77, 5}),
                  {kNan, kNan, kNan, 5});
}

TEST(NetcdfPacking, MissingValuesThatNoSampleCanEqualAreIgnored) {
    expectSamples(
        Packed(NC_BYTE).number("missing_value", NC_DOUBLE, {1e20, 0.5, 300, -7}).read({0, 1, 44, -7}),
        {0, 1, 44, kNan});
}

TEST(NetcdfPacking, MissingValuesOf64BitsAreComparedExactly) {
    Packed packed(NC_INT64);
    const long long fill = (1LL << 60) + 1;
    const std::vector<long long> values{fill, fill - 1, 1, 1, 1, 1, 1, 1};
    NetcdfWriter& writer = packed.writer();
    const int id = writer.variableId("F");
    ASSERT_EQ(nc_put_att_longlong(writer.id(), id, "missing_value", NC_INT64, 1, &fill), NC_NOERR);
    ASSERT_EQ(nc_enddef(writer.id()), NC_NOERR);
    ASSERT_EQ(nc_put_var_longlong(writer.id(), id, values.data()), NC_NOERR);
    expectSamples(packed.readBack(3), {kNan, std::ldexp(1.0, 60), 1});
}

TEST(NetcdfPacking, UnsignedFlagMakesBytesUnsigned) {
    expectSamples(Packed(NC_BYTE)
                      .text("_Unsigned", "true")
                      .number("_FillValue", NC_BYTE, {-1})
                      .number("missing_value", NC_BYTE, {-2})
                      .number("valid_max", NC_BYTE, {-56})
                      .read({-1, -2, -56, -55, 127, -128}),
                  {kNan, kNan, 200, kNan, 127, 128});
    expectSamples(Packed(NC_SHORT).text("_Unsigned", "true").read({-1, 1}), {65535, 1});
}

TEST(NetcdfPacking, ValidRangeIsClosed) {
    expectSamples(Packed(NC_SHORT).number("valid_range", NC_SHORT, {0, 10}).read({-1, 0, 10, 11}),
                  {kNan, 0, 10, kNan});
    expectSamples(Packed(NC_SHORT).number("valid_min", NC_SHORT, {0}).read({-1, 0, 11}), {kNan, 0, 11});
    expectSamples(Packed(NC_SHORT).number("valid_max", NC_SHORT, {10}).read({-1, 10, 11}), {-1, 10, kNan});
    expectSamples(Packed(NC_FLOAT).number("valid_max", NC_DOUBLE, {0.1}).read({0.1, 0.2}), {0.1, kNan});
}

TEST(NetcdfPacking, ValidRangeCountsUnpackedWhereItsTypeSaysSo) {
    // Wider than the stored type and that of the scale: limits of the unpacked values.
    expectSamples(Packed(NC_SHORT)
                      .number("scale_factor", NC_FLOAT, {0.5})
                      .number("valid_range", NC_FLOAT, {0, 10})
                      .read({20, 22, -1}),
                  {10, kNan, kNan});
    expectSamples(Packed(NC_SHORT)
                      .number("scale_factor", NC_FLOAT, {0.5})
                      .number("valid_range", NC_SHORT, {0, 20})
                      .read({20, 22}),
                  {10, kNan});
}

TEST(NetcdfPacking, SamplesThatNoFloatHoldsAreMissing) {
    expectSamples(Packed(NC_FLOAT).read({1, kNan, kInf, -kInf, 1.8e38, -1.8e38, 1.6e38}),
                  {1, kNan, kNan, kNan, kNan, kNan, 1.6e38});
    expectSamples(Packed(NC_DOUBLE).read({1, 1e300, -1e300}), {1, kNan, kNan});
    expectSamples(Packed(NC_SHORT).number("scale_factor", NC_DOUBLE, {1e37}).read({1, 1000}), {1e37, kNan});
}

}  // namespace

}  // namespace isoglass
