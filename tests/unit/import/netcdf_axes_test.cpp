#include "unit/import/import_check.h"
#include "unit/import/netcdf_writer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>

namespace isoglass {

namespace {

using test::failsWith;
using test::hasNote;
using test::NetcdfWriter;
using test::readFrame;
using test::scratchFile;
using test::writeStandardVolume;

std::unique_ptr<FrameSource> open(NetcdfWriter& writer, const ImportOptions& options = {}) {
    return openNetcdf(writer.close(), options);
}

/// Value of sample (x,y,z) of the standard volume at key frame t.
float standardSample(int t, int z, int y, int x) {
    return static_cast<float>(1000 * t + 100 * z + 10 * y + x);
}

void expectStandardSamples(FrameSource& source) {
    for (int t = 0; t < 2; ++t) {
        const std::vector<float> samples = readFrame(source, static_cast<std::size_t>(t));
        ASSERT_EQ(samples.size(), 24u);
        for (int z = 0; z < 2; ++z)
            for (int y = 0; y < 3; ++y)
                for (int x = 0; x < 4; ++x)
                    EXPECT_EQ(samples[(z * 3 + y) * 4 + x], standardSample(t, z, y, x))
                        << "t " << t << " z " << z << " y " << y << " x " << x;
    }
}

TEST(NetcdfAxes, StandardVolumeIsReadAsItIs) {
    NetcdfWriter writer(scratchFile("a.nc"));
    writeStandardVolume(writer).text("T", "units", "degC").text("T", "long_name", "Temperature");
    writer.text("", "title", "An analytic field").text("", "history", "made by a test");
    const auto source = open(writer);
    const SeriesDescription& description = source->description();
    EXPECT_EQ(description.name, "T");
    EXPECT_EQ(description.units, "degC");
    EXPECT_EQ(description.longName, "Temperature");
    EXPECT_EQ(description.provenance,
              scratchFile("a.nc").filename().string() +
                  ", NetCDF, variable T; title: An analytic field; history: made by a test");
    const auto& [x, y, z] = description.lattice.axes;
    EXPECT_EQ(x.coordinates, (std::vector<double>{0, 10, 20, 30}));
    EXPECT_EQ(x.units, "degrees_east");
    EXPECT_FALSE(x.period);
    EXPECT_EQ(y.coordinates, (std::vector<double>{-10, 0, 10}));
    EXPECT_EQ(z.coordinates, (std::vector<double>{0, 50}));
    EXPECT_EQ(z.name, "lev");
    EXPECT_TRUE(description.notes.empty());
    expectStandardSamples(*source);
}

TEST(NetcdfAxes, EveryOrderOfDimensionsGivesTheSameSamples) {
    struct Named {
        const char* name;
        int length;
        int weight;
        const char* units;
    };
    std::vector<Named> order{{"lat", 3, 10, "degrees_north"},
                             {"lev", 2, 100, "hPa"},
                             {"lon", 4, 1, "degrees_east"},
                             {"time", 2, 1000, "days since 2000-01-01"}};
    const auto byName = [](const Named& a, const Named& b) { return std::string_view(a.name) < b.name; };
    int orders = 0;
    do {
        NetcdfWriter writer(scratchFile("order.nc"));
        std::vector<std::string> names;
        for (const Named& axis : order) {
            writer.dimension(axis.name, static_cast<std::size_t>(axis.length));
            std::vector<double> counted;
            for (int i = 0; i < axis.length; ++i) counted.push_back(i);
            writer.coordinate(axis.name, counted, axis.units);
            names.push_back(axis.name);
        }
        std::vector<double> samples{0};
        for (const Named& axis : order) {
            std::vector<double> finer;
            for (const double base : samples)
                for (int i = 0; i < axis.length; ++i) finer.push_back(base + i * axis.weight);
            samples = finer;
        }
        writer.variable("T", NC_FLOAT, names).values("T", samples);
        SCOPED_TRACE(names[0] + " " + names[1] + " " + names[2] + " " + names[3]);
        const auto source = open(writer);
        EXPECT_EQ(source->description().lattice.axes[2].name, "lev");
        expectStandardSamples(*source);
        ++orders;
    } while (std::next_permutation(order.begin(), order.end(), byName));
    EXPECT_EQ(orders, 24);
}

TEST(NetcdfAxes, AxesAreKnownByAnyOfTheirAttributes) {
    const auto attributes = std::vector<std::array<std::pair<const char*, const char*>, 4>>{
        {{{"axis", "T"}, {"axis", "x"}, {"axis", "Y"}, {"axis", "Z"}}},
        {{{"standard_name", "time"},
          {"standard_name", "projection_x_coordinate"},
          {"standard_name", "latitude"},
          {"standard_name", "ocean_sigma_coordinate"}}},
        {{{"units", "s since 2000-01-01"},
          {"units", "degree_E"},
          {"units", "degrees_N"},
          {"positive", "up"}}},
    };
    for (const auto& [time, x, y, z] : attributes) {
        // The order of the dimensions, x y z t, is the reverse of the fallback by position.
        NetcdfWriter writer(scratchFile("roles.nc"));
        writer.dimension("a", 3).dimension("b", 4).dimension("c", 5).dimension("d", 2);
        writer.coordinate("a", {0, 1, 2}).coordinate("b", {0, 1, 2, 3});
        writer.coordinate("c", {0, 1, 2, 3, 4}).coordinate("d", {0, 1});
        writer.text("a", x.first, x.second).text("b", y.first, y.second);
        writer.text("c", z.first, z.second).text("d", time.first, time.second);
        writer.variable("F", NC_FLOAT, {"a", "b", "c", "d"}).values("F", std::vector<double>(120, 1));
        const SeriesDescription description = open(writer)->description();
        EXPECT_EQ(description.lattice.axes[0].name, "a");
        EXPECT_EQ(description.lattice.axes[1].name, "b");
        EXPECT_EQ(description.lattice.axes[2].name, "c");
        EXPECT_EQ(description.time.times.size(), 2u);
    }
}

TEST(NetcdfAxes, UnmarkedDimensionsAreTakenByPosition) {
    NetcdfWriter writer(scratchFile("a.nc"));
    writer.dimension("n", 2).dimension("k", 5).dimension("j", 4).dimension("i", 3);
    writer.variable("F", NC_DOUBLE, {"n", "k", "j", "i"}).values("F", std::vector<double>(120, 1));
    const SeriesDescription description = open(writer)->description();
    EXPECT_EQ(description.lattice.axes[0].name, "i");
    EXPECT_EQ(description.lattice.axes[1].name, "j");
    EXPECT_EQ(description.lattice.axes[2].name, "k");
    EXPECT_EQ(description.time.times, (std::vector<double>{0, 1}));
    EXPECT_EQ(description.lattice.axes[1].coordinates, (std::vector<double>{0, 1, 2, 3}));
    EXPECT_TRUE(hasNote(description, "Axis j has no coordinates"));
    EXPECT_TRUE(hasNote(description, "Time dimension n has no coordinates"));
}

TEST(NetcdfAxes, DimensionsOfOneSampleAreLeftOut) {
    NetcdfWriter writer(scratchFile("a.nc"));
    writer.dimension("member", 1).dimension("k", 2).dimension("j", 2).dimension("i", 2);
    writer.variable("F", NC_FLOAT, {"k", "member", "j", "i"}).values("F", {0, 1, 2, 3, 4, 5, 6, 7});
    const auto source = open(writer);
    EXPECT_EQ(source->description().time.times, std::vector<double>{0});
    EXPECT_EQ(readFrame(*source, 0), (std::vector<float>{0, 1, 2, 3, 4, 5, 6, 7}));
}

TEST(NetcdfAxes, DownwardAxisIsNegated) {
    NetcdfWriter writer(scratchFile("a.nc"));
    writeStandardVolume(writer).text("lev", "positive", "down");
    const auto source = open(writer);
    const Axis& z = source->description().lattice.axes[2];
    EXPECT_EQ(z.coordinates, (std::vector<double>{-0.0, -50}));
    EXPECT_TRUE(z.negated);
    EXPECT_TRUE(z.descending());
    EXPECT_TRUE(hasNote(source->description(), "Axis lev points down"));
    expectStandardSamples(*source);
}

TEST(NetcdfAxes, DescendingLatitudeIsKept) {
    NetcdfWriter writer(scratchFile("a.nc"));
    writeStandardVolume(writer).values("lat", {10, 0, -10});
    const auto source = open(writer);
    EXPECT_EQ(source->description().lattice.axes[1].coordinates, (std::vector<double>{10, 0, -10}));
    EXPECT_FALSE(source->description().lattice.axes[1].negated);
    EXPECT_TRUE(hasNote(source->description(), "Axis lat descends"));
    expectStandardSamples(*source);
}

TEST(NetcdfAxes, PackedCoordinatesAreUnpacked) {
    NetcdfWriter writer(scratchFile("a.nc"));
    writeStandardVolume(writer).numbers("lev", "scale_factor", NC_DOUBLE, {0.5});
    writer.numbers("lev", "add_offset", NC_DOUBLE, {7});
    EXPECT_EQ(open(writer)->description().lattice.axes[2].coordinates, (std::vector<double>{7, 32}));
}

TEST(NetcdfAxes, WholeCircleOfLongitudeIsPeriodic) {
    for (const auto& longitudes : {std::vector<double>{20.5, 110.5, 200.5, 290.5}, {270, 180, 90, 0}}) {
        NetcdfWriter writer(scratchFile("a.nc"));
        writeStandardVolume(writer).values("lon", longitudes);
        const SeriesDescription description = open(writer)->description();
        EXPECT_EQ(description.lattice.axes[0].period, 360);
        EXPECT_TRUE(hasNote(description, "repeats after 360 degrees_east"));
    }
}

TEST(NetcdfAxes, LessOrMoreThanACircleIsNotPeriodic) {
    // A gap, the first meridian repeated, and a step that is off by 1 %.
    for (const auto& longitudes :
         {std::vector<double>{0, 80, 160, 240}, {0, 120, 240, 360}, {0, 89.1, 178.2, 267.3}}) {
        NetcdfWriter writer(scratchFile("a.nc"));
        writeStandardVolume(writer).values("lon", longitudes);
        EXPECT_FALSE(open(writer)->description().lattice.axes[0].period) << longitudes[1];
    }
}

TEST(NetcdfAxes, ModuloGivesTheLengthOfACircle) {
    NetcdfWriter writer(scratchFile("a.nc"));
    writeStandardVolume(writer).numbers("lon", "modulo", NC_DOUBLE, {40}).text("lon", "units", "m");
    writer.text("lon", "axis", "X")
        .text("lat", "modulo", "30")
        .text("lat", "units", "m")
        .text("lat", "axis", "Y");
    const SeriesDescription description = open(writer)->description();
    EXPECT_EQ(description.lattice.axes[0].period, 40);
    EXPECT_EQ(description.lattice.axes[1].period, 30);
}

TEST(NetcdfAxes, ModuloThatIsNoLengthIsIgnored) {
    for (const double bad :
         {0.0, -40.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
        NetcdfWriter writer(scratchFile("a.nc"));
        writeStandardVolume(writer).numbers("lon", "modulo", NC_DOUBLE, {bad}).text("lon", "units", "m");
        EXPECT_FALSE(open(writer)->description().lattice.axes[0].period) << bad;
    }
}

TEST(NetcdfAxes, CircleInSinglePrecisionIsPeriodic) {
    NetcdfWriter writer(scratchFile("a.nc"));
    constexpr int kCount = 1440;
    writer.dimension("z", 2).dimension("y", 2).dimension("lon", kCount).variable("lon", NC_FLOAT, {"lon"});
    std::vector<double> longitudes;
    for (int i = 0; i < kCount; ++i) longitudes.push_back(360.0 * i / kCount + 0.1);
    writer.text("lon", "units", "degrees_east").values("lon", longitudes);
    writer.variable("F", NC_BYTE, {"z", "y", "lon"}).values("F", std::vector<double>(4 * kCount, 1));
    EXPECT_EQ(open(writer)->description().lattice.axes[0].period, 360);
}

TEST(NetcdfAxes, CoordinatesAreFoundUnderAnotherName) {
    NetcdfWriter writer(scratchFile("a.nc"));
    writer.dimension("record", 2).dimension("k", 2).dimension("j", 2).dimension("i", 2);
    writer.variable("XTIME", NC_FLOAT, {"record"}).text("XTIME", "units", "minutes since 2005-08-28");
    writer.values("XTIME", {720, 900}).variable("height", NC_FLOAT, {"k"}).values("height", {10, 40});
    writer.variable("Q", NC_FLOAT, {"record", "k", "j", "i"}).text("Q", "coordinates", "XLAT height XTIME");
    writer.values("Q", std::vector<double>(16, 1));
    const SeriesDescription description = open(writer)->description();
    EXPECT_EQ(description.time.times, (std::vector<double>{720, 900}));
    EXPECT_EQ(description.lattice.axes[2].coordinates, (std::vector<double>{10, 40}));
}

TEST(NetcdfAxes, TheOnlyVolumeIsChosen) {
    NetcdfWriter writer(scratchFile("a.nc"));
    writeStandardVolume(writer).variable("ground", NC_FLOAT, {"time", "lat", "lon"});
    writer.dimension("corner", 4).variable("corners", NC_FLOAT, {"lat", "lon", "corner"});
    writer.text("lat", "bounds", "corners").variable("label", NC_CHAR, {"lev", "lat", "lon"});
    EXPECT_EQ(open(writer)->description().name, "T");
}

TEST(NetcdfAxes, SeveralVolumesAreListed) {
    NetcdfWriter writer(scratchFile("a.nc"));
    writeStandardVolume(writer).variable("S", NC_FLOAT, {"lev", "lat", "lon"});
    EXPECT_TRUE(failsWith([&] { open(writer); },
                          {"several", "T(time, lev, lat, lon), S(lev, lat, lon)", "--variable"}));
    EXPECT_EQ(openNetcdf(scratchFile("a.nc"), {"S", {}})->description().time.times, std::vector<double>{0});
}

TEST(NetcdfAxes, LongReadsComeInSeveralSlabs) {
    // 300 x 300 x 200 samples are more than the 2^24 that are read at a time.
    constexpr int kSize = 300;
    constexpr int kDepth = 200;
    NetcdfWriter writer(scratchFile("a.nc"), NC_64BIT_OFFSET);
    writer.dimension("i", kSize).dimension("j", kSize).dimension("k", kDepth);
    writer.coordinate("i", std::vector<double>{[] {
                          std::vector<double> values(kSize);
                          for (int n = 0; n < kSize; ++n) values[n] = n;
                          return values;
                      }()});
    writer.text("i", "axis", "X").variable("F", NC_BYTE, {"i", "j", "k"});
    std::vector<double> samples;
    for (int i = 0; i < kSize; ++i)
        for (int j = 0; j < kSize; ++j)
            for (int k = 0; k < kDepth; ++k) samples.push_back((i * 7 + j * 3 + k) % 100);
    writer.values("F", samples);
    const auto source = open(writer);
    const std::vector<float> read = readFrame(*source, 0);
    std::size_t wrong = 0;
    for (int i = 0; i < kSize; ++i)
        for (int j = 0; j < kSize; ++j)
            for (int k = 0; k < kDepth; ++k)
                // x is i; of the unmarked ones k, the last, becomes y and j becomes z.
                if (read[(std::size_t(j) * kDepth + k) * kSize + i] != (i * 7 + j * 3 + k) % 100) ++wrong;
    EXPECT_EQ(wrong, 0u);
    std::filesystem::remove(scratchFile("a.nc"));
}

}  // namespace

}  // namespace isoglass
