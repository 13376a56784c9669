#include "app/app_test.h"

#include <nlohmann/json.hpp>

namespace isoglass::test {
namespace {

using Json = nlohmann::json;

const std::string kExcerpt = ISOGLASS_DATA_FOLDER "/ocean_excerpt.nc";

class DerivedField : public AppTest {
  protected:
    Json info(const std::string& series) const {
        return Json::parse(run({"info", series, "--json"}).out).at("series").at(0);
    }
};

TEST_F(DerivedField, IsImportedUnderItsName) {
    importOcean();
    run({"import", kExcerpt, "--variable", "kelvin = TEMP + 273.15", "-o", "kelvin.vdb"});
    const Json series = info("kelvin.vdb");
    EXPECT_EQ(series.at("name"), "kelvin");
    EXPECT_EQ(series.at("long_name"), "TEMP + 273.15");
    EXPECT_EQ(series.at("heights"), nullptr);
    EXPECT_EQ(series.at("missing_fraction"), info("ocean.vdb").at("missing_fraction"));
    const double celsius = info("ocean.vdb").at("range").at(1);
    // The sum is rounded to a float below 512: half of 2^-15; it is printed exactly.
    EXPECT_NEAR(series.at("range").at(1), celsius + 273.15, 0x1p-16);
}

TEST_F(DerivedField, ErrorsNameOptionAndColumn) {
    const RunResult formula = isoglass({"import", kExcerpt, "--variable", "sqrt(TEMP", "-o", "new.vdb"});
    EXPECT_EQ(formula.status, 1);
    EXPECT_TRUE(contains(formula.err, "ocean_excerpt.nc, --variable, column 5")) << formula.err;
    const RunResult height = isoglass({"import", kExcerpt, "--height", "2*DEPTH", "-o", "new.vdb"});
    EXPECT_EQ(height.status, 1);
    EXPECT_TRUE(contains(height.err, "no variable \"DEPTH\"")) << height.err;
    EXPECT_TRUE(contains(height.err, "--height, column 3")) << height.err;
    std::ofstream(folder_ / "a.pvm", std::ios::binary) << "PVM\n2 2 2\n1\n01234567";
    const RunResult other = isoglass({"import", "a.pvm", "--height", "h", "-o", "new.vdb"});
    EXPECT_EQ(other.status, 1);
    EXPECT_TRUE(contains(other.err, "have no heights (--height")) << other.err;
    EXPECT_EQ(files(), (std::set<std::string>{"a.pvm"}));
}

/// Depths as heights are what the axis says anyway: the same surface, by the other way.
TEST_F(DerivedField, HeightsOfTheAxisGiveTheSameSurface) {
    importOcean();
    run({"import", kExcerpt, "--height", "-ZAXLEVIT19", "-o", "heights.vdb"});
    const Json series = info("heights.vdb");
    EXPECT_EQ(series.at("heights").at("name"), "-ZAXLEVIT19");
    EXPECT_EQ(series.at("heights").at("range"), Json({-1000.0, 0.0}));
    EXPECT_EQ(series.at("bounds"), info("ocean.vdb").at("bounds"));
    EXPECT_EQ(series.at("axes").at(2).at("coordinates"),
              info("ocean.vdb").at("axes").at(2).at("coordinates"));
    EXPECT_TRUE(contains(run({"info", "heights.vdb"}).out, "heights   -ZAXLEVIT19: -1000 to 0"));
    for (const char* time : {"366", "700"}) {
        run({"mesh", "ocean.vdb", "--iso", "15", "--time", time, "-o", "axis.stl"});
        run({"mesh", "heights.vdb", "--iso", "15", "--time", time, "-o", "heights.stl"});
        EXPECT_GT(bytesOf("axis.stl").size(), 50'000u);
        EXPECT_EQ(bytesOf("heights.stl"), bytesOf("axis.stl")) << "positions are equal bit by bit";
    }
}

TEST_F(DerivedField, SeriesWithHeightsAreNotExported) {
    run({"import", kExcerpt, "--height", "-ZAXLEVIT19", "-o", "heights.vdb"});
    const RunResult result = isoglass({"export", "heights.vdb", "-o", "heights.json"});
    EXPECT_EQ(result.status, 1);
    EXPECT_TRUE(contains(result.err, "heights") && contains(result.err, "(heights.vdb")) << result.err;
    EXPECT_EQ(files(), (std::set<std::string>{"heights.vdb"}));
}

}  // namespace
}  // namespace isoglass::test
