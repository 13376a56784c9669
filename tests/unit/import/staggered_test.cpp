#include "unit/import/import_check.h"
#include "unit/import/netcdf_writer.h"
#include "volume/calendar.h"

#include <gtest/gtest.h>

#include <array>
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

constexpr int kTimes = 2;
constexpr int kNx = 4;
constexpr int kNy = 3;
constexpr int kNz = 2;
constexpr double kFill = 9e36;

using Formula = std::function<double(int t, int z, int y, int x)>;

void fill(NetcdfWriter& writer, const std::string& name, std::array<int, 4> lengths, const Formula& value) {
    std::vector<double> samples;
    for (int t = 0; t < lengths[0]; ++t)
        for (int z = 0; z < lengths[1]; ++z)
            for (int y = 0; y < lengths[2]; ++y)
                for (int x = 0; x < lengths[3]; ++x) samples.push_back(value(t, z, y, x));
    writer.values(name, samples);
}

/// A file as WRF writes it: U, V, W on the faces, T at the centres, HGT without levels, all of numbers that
/// floats hold exactly.
class WrfFile {
  public:
    WrfFile() : writer_(scratchFile("wrf" + std::to_string(count_++) + ".nc")) {
        for (const auto& [name, length] : {std::pair{"Time", kTimes},
                                           {"west_east", kNx},
                                           {"south_north", kNy},
                                           {"bottom_top", kNz},
                                           {"west_east_stag", kNx + 1},
                                           {"south_north_stag", kNy + 1},
                                           {"bottom_top_stag", kNz + 1},
                                           {"soil_layers_stag", 3},
                                           {"DateStrLen", 19}})
            writer_.dimension(name, static_cast<std::size_t>(length));
        add("T", {"Time", "bottom_top", "south_north", "west_east"}, "");
        add("U", {"Time", "bottom_top", "south_north", "west_east_stag"}, "X");
        add("V", {"Time", "bottom_top", "south_north_stag", "west_east"}, "Y");
        add("W", {"Time", "bottom_top_stag", "south_north", "west_east"}, "Z");
        add("TSLB", {"Time", "soil_layers_stag", "south_north", "west_east"}, "Z");
        add("HGT", {"Time", "south_north", "west_east"}, "");
        writer_.variable("ZNU", NC_FLOAT, {"bottom_top"});
        fill(writer_, "T", {kTimes, kNz, kNy, kNx}, t);
        fill(writer_, "U", {kTimes, kNz, kNy, kNx + 1}, u);
        fill(writer_, "V", {kTimes, kNz, kNy + 1, kNx}, v);
        fill(writer_, "W", {kTimes, kNz + 1, kNy, kNx}, w);
        fill(writer_, "TSLB", {kTimes, 3, kNy, kNx}, t);
        fill(writer_, "HGT", {1, kTimes, kNy, kNx},
             [](int, int time, int y, int x) { return hgt(time, y, x); });
        writer_.values("ZNU", {0.75, 0.25});
    }

    NetcdfWriter& writer() { return writer_; }
    std::unique_ptr<FrameSource> open(const std::string& variable, const std::string& height = {}) {
        return openNetcdf(writer_.close(), {variable, {}, height});
    }

    static double t(int time, int z, int y, int x) { return 1000 * time + 100 * z + 10 * y + x; }
    // Quadratic along the staggered axis, so that the mean of neighbours is not the value in between.
    static double u(int time, int z, int y, int x) {
        return x == 2 && y == 1 ? kFill : x * x + 10 * y + 100 * z + time;
    }
    static double v(int time, int z, int y, int x) { return 3 * x + y * y - z + 8 * time; }
    static double w(int time, int z, int y, int x) { return x + y + z * z * (1 + time); }
    static double hgt(int time, int y, int x) { return 0.5 * x + y + time; }

  private:
    void add(const std::string& name, const std::vector<std::string>& dimensions,
             const std::string& stagger) {
        writer_.variable(name, NC_FLOAT, dimensions);
        writer_.text(name, "stagger", stagger);
        writer_.numbers(name, "_FillValue", NC_FLOAT, {kFill});
    }

    static inline int count_ = 0;  ///< a file that is open cannot be written again

    NetcdfWriter writer_;
};

/// Compares all samples of both key frames; NaN is wanted where the formula gives one.
void expectSamples(FrameSource& source, const Formula& wanted) {
    const glm::ivec3 dims = source.description().lattice.dims();
    for (int time = 0; time < kTimes; ++time) {
        const std::vector<float> samples = readFrame(source, static_cast<std::size_t>(time));
        std::size_t i = 0;
        for (int z = 0; z < dims.z; ++z)
            for (int y = 0; y < dims.y; ++y)
                for (int x = 0; x < dims.x; ++x, ++i) {
                    const auto value = static_cast<float>(wanted(time, z, y, x));
                    ASSERT_TRUE(std::isnan(value) ? std::isnan(samples[i]) : samples[i] == value)
                        << samples[i] << " instead of " << value << " at " << x << ' ' << y << ' ' << z
                        << ", key frame " << time;
                }
    }
}

/// Mean of neighbours along x, y or z (0 to 2), as floats give it; missing where one is.
Formula centred(const Formula& formula, int axis) {
    return [=](int t, int z, int y, int x) {
        const double a = formula(t, z, y, x);
        const double b = formula(t, z + (axis == 2), y + (axis == 1), x + (axis == 0));
        return a == kFill || b == kFill ? std::nan("") : 0.5 * (a + b);
    };
}

TEST(Staggered, SingleVariablesComeToTheCellCentres) {
    const std::pair<const char*, Formula> cases[] = {{"T", WrfFile::t},
                                                     {"U", centred(WrfFile::u, 0)},
                                                     {"V", centred(WrfFile::v, 1)},
                                                     {"W", centred(WrfFile::w, 2)}};
    for (const auto& [name, wanted] : cases) {
        SCOPED_TRACE(name);
        WrfFile file;
        const auto source = file.open(name);
        EXPECT_EQ(source->description().lattice.dims(), glm::ivec3(kNx, kNy, kNz));
        EXPECT_EQ(source->description().name, name);
        expectSamples(*source, wanted);
        EXPECT_EQ(static_cast<bool>(hasNote(source->description(), "is staggered along")), *name != 'T');
    }
}

TEST(Staggered, OnlyTheConventionMakesADimensionStaggered) {
    WrfFile file;
    // No dimension soil_layers: these are layers of their own.
    const auto source = file.open("TSLB");
    EXPECT_EQ(source->description().lattice.dims(), glm::ivec3(kNx, kNy, 3));
    expectSamples(*source, WrfFile::t);
    // The attribute takes the suffix back.
    WrfFile other;
    other.writer().text("W", "stagger", " ");
    EXPECT_EQ(other.open("W")->description().lattice.dims(), glm::ivec3(kNx, kNy, kNz + 1));
}

TEST(Staggered, CoordinatesComeToTheCentresToo) {
    NetcdfWriter writer(scratchFile("a.nc"));
    writer.dimension("z", 2).dimension("y", 2).dimension("x", 3).dimension("x_stag", 4);
    writer.variable("F", NC_FLOAT, {"z", "y", "x_stag"});
    writer.coordinate("x_stag", {0, 1, 4, 9}, "km");
    writer.values("F", std::vector<double>(16, 1));
    const auto source = openNetcdf(writer.close(), {});
    const Axis& axis = source->description().lattice.axes[0];
    EXPECT_EQ(axis.name, "x");
    EXPECT_EQ(axis.units, "km");
    EXPECT_EQ(axis.coordinates, (std::vector<double>{0.5, 2.5, 6.5}));
}

TEST(Staggered, ProjectedGridsAreInMetres) {
    WrfFile file;
    file.writer().numbers("", "DX", NC_FLOAT, {10000});
    file.writer().numbers("", "DY", NC_FLOAT, {8000});
    const SeriesDescription description = file.open("U")->description();
    const auto& [x, y, z] = description.lattice.axes;
    EXPECT_EQ(x.coordinates, (std::vector<double>{0, 10000, 20000, 30000}));
    EXPECT_EQ(y.coordinates, (std::vector<double>{0, 8000, 16000}));
    EXPECT_EQ(z.coordinates, (std::vector<double>{0, 1}));
    EXPECT_EQ(x.units, "m");
    EXPECT_EQ(z.units, "");
    EXPECT_TRUE(hasNote(description, "map projection"));
    WrfFile bad;
    bad.writer().numbers("", "DX", NC_FLOAT, {0});
    EXPECT_EQ(bad.open("U")->description().lattice.axes[0].coordinates, (std::vector<double>{0, 1, 2, 3}));
}

TEST(DerivedField, IsEvaluatedAtTheCellCentres) {
    WrfFile file;
    const auto source = file.open("sqrt(U^2 + V^2)");
    const SeriesDescription& description = source->description();
    EXPECT_EQ(description.name, "sqrt(U^2 + V^2)");
    EXPECT_EQ(description.units, "");
    EXPECT_TRUE(description.provenance.find("expression sqrt(U^2 + V^2)") != std::string::npos);
    expectSamples(*source, [](int t, int z, int y, int x) {
        return std::sqrt(std::pow(centred(WrfFile::u, 0)(t, z, y, x), 2) +
                         std::pow(centred(WrfFile::v, 1)(t, z, y, x), 2));
    });
}

TEST(DerivedField, GetsTheNameBeforeTheEqualsSign) {
    WrfFile file;
    const auto source = file.open("twice = 2*T");
    EXPECT_EQ(source->description().name, "twice");
    EXPECT_EQ(source->description().longName, "2*T");
    expectSamples(*source, [](int t, int z, int y, int x) { return 2 * WrfFile::t(t, z, y, x); });
    WrfFile renamed;
    renamed.writer().text("T", "units", "K");
    const auto plain = renamed.open("theta = T");
    EXPECT_EQ(plain->description().name, "theta");
    EXPECT_EQ(plain->description().units, "K");
    expectSamples(*plain, WrfFile::t);
}

TEST(DerivedField, VariablesWithoutADimensionAreTheSameAlongIt) {
    WrfFile file;
    const auto source = file.open("HGT + 10*ZNU + 0*T");
    EXPECT_TRUE(hasNote(source->description(), "HGT has no dimension bottom_top"));
    EXPECT_TRUE(hasNote(source->description(), "ZNU has no dimension west_east"));
    expectSamples(*source,
                  [](int t, int z, int y, int x) { return WrfFile::hgt(t, y, x) + (z == 0 ? 7.5 : 2.5); });
}

TEST(DerivedField, WhatTheFileLacksIsNamedWithItsColumn) {
    WrfFile file;
    const auto path = file.writer().close();
    const auto open = [&](const std::string& variable) { openNetcdf(path, {variable, {}}); };
    EXPECT_TRUE(failsWith([&] { open("sqrt(U^2 + Q^2)"); },
                          {"no variable \"Q\"", "--variable, column 12", "T(Time,"}));
    EXPECT_TRUE(failsWith([&] { open("s = Q"); }, {"no variable \"Q\"", "column 5"}));
    EXPECT_TRUE(failsWith([&] { open("sqrt(U^2"); }, {"never closed", ".nc, --variable, column 5"}));
    EXPECT_TRUE(failsWith([&] { open("1 + 2"); }, {"has no variable", "volumes in the file"}));
    EXPECT_TRUE(failsWith([&] { open("HGT + 1"); }, {"HGT(Time, south_north, west_east)", "three axes"}));
    EXPECT_TRUE(failsWith([&] { open("T + TSLB"); },
                          {"dimension soil_layers_stag (3)", "variable TSLB", "bottom_top (2)", "one grid"}));
}

TEST(DerivedField, AVariableOfThatVeryNameIsTakenAsItIs) {
    NetcdfWriter writer(scratchFile("a.nc"));
    test::writeStandardVolume(writer);
    writer.variable("T-2", NC_FLOAT, {"time", "lev", "lat", "lon"});
    writer.values("T-2", std::vector<double>(48, 7));
    const auto path = writer.close();
    EXPECT_EQ(readFrame(*openNetcdf(path, {"T-2", {}}), 0)[1], 7);
    EXPECT_EQ(readFrame(*openNetcdf(path, {"T - 2", {}}), 0)[1], -1);
    EXPECT_EQ(readFrame(*openNetcdf(path, {"`T-2` + T", {}}), 0)[1], 8);
}

void addTimes(WrfFile& file, const std::string& text) {
    file.writer().variable("Times", NC_CHAR, {"Time", "DateStrLen"});
    nc_enddef(file.writer().id());
    ASSERT_EQ(nc_put_var_text(file.writer().id(), file.writer().variableId("Times"), text.data()), NC_NOERR);
}

TEST(WrfTimes, AreRealDates) {
    WrfFile file;
    addTimes(file, "2005-08-28_22:00:002005-08-29_01:30:00");
    const TimeAxis time = file.open("T")->description().time;
    EXPECT_EQ(time.times, (std::vector<double>{0, 210}));
    EXPECT_EQ(dateFromAxisTime(time, 0), "2005-08-28T22:00:00");
    EXPECT_EQ(dateFromAxisTime(time, 210), "2005-08-29T01:30:00");
}

TEST(WrfTimes, GiveWayToACoordinateWithADate) {
    WrfFile file;
    addTimes(file, "2005-08-28_22:00:002005-08-29_01:30:00");
    file.writer().variable("Time", NC_DOUBLE, {"Time"}).text("Time", "units", "hours since 2000-01-01");
    file.writer().values("Time", {3, 4});
    EXPECT_EQ(file.open("T")->description().time.times, (std::vector<double>{3, 4}));
    WrfFile undated;
    addTimes(undated, "2005-08-28_22:00:002005-08-29_01:30:00");
    undated.writer().variable("Time", NC_DOUBLE, {"Time"}).values("Time", {3, 4});
    EXPECT_EQ(undated.open("T")->description().time.times, (std::vector<double>{0, 210}));
}

TEST(WrfTimes, DamagedOnesAreNoted) {
    WrfFile file;
    addTimes(file, "2005-08-28_22:00:002005-02-30_01:30:00");
    const SeriesDescription description = file.open("T")->description();
    EXPECT_EQ(description.time.times, (std::vector<double>{0, 1}));
    EXPECT_TRUE(hasNote(description, "Times[1] is not understood as a date"));
    WrfFile backwards;
    addTimes(backwards, "2005-08-28_22:00:002005-08-28_01:30:00");
    EXPECT_TRUE(failsWith([&] { backwards.open("T"); }, {"strictly increase", "index 1", "variable Times"}));
}

}  // namespace
}  // namespace isoglass
