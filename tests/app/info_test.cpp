#include "app/app_test.h"

#include <nlohmann/json.hpp>

namespace isoglass::test {
namespace {

using Json = nlohmann::json;

class Info : public AppTest {
  protected:
    void SetUp() override { importOcean(); }
};

TEST_F(Info, ImportSaysWhatItWrote) {
    const RunResult result =
        run({"import", ISOGLASS_DATA_FOLDER "/ocean_excerpt.nc", "-o", "again.vdb", "--variable", "TEMP"});
    EXPECT_TRUE(contains(result.out, "again.vdb: TEMP, 12 key frames")) << result.out;
    EXPECT_EQ(bytesOf("again.vdb"), bytesOf("ocean.vdb"));
    EXPECT_EQ(files(), (std::set<std::string>{"again.vdb", "ocean.vdb"}));
}

/// What data/README.md says of the excerpt, and the keys that scripts rely on.
TEST_F(Info, JsonHoldsTheKnownFacts) {
    const Json series = Json::parse(run({"info", "ocean.vdb", "--json"}).out).at("series").at(0);
    EXPECT_EQ(series.at("name"), "TEMP");
    EXPECT_EQ(series.at("file"), "ocean.vdb");
    EXPECT_EQ(series.at("dims"), Json({36, 23, 19}));
    EXPECT_EQ(series.at("times").size(), 12u);
    EXPECT_TRUE(contains(series.at("time_units"), " since 0000-01-01")) << series.at("time_units");
    EXPECT_TRUE(series.at("calendar").is_string());
    EXPECT_EQ(series.at("units"), "");
    EXPECT_FALSE(series.at("time_period").is_null()) << "a climatology repeats";
    // The sea is between freezing and the warmest surface water there is.
    EXPECT_GE(series.at("range").at(0), -3);
    EXPECT_LT(series.at("range").at(1), 35);
    // The whole atlas misses 39.4 %; every twentieth column of it may differ by a few percent.
    EXPECT_NEAR(series.at("missing_fraction"), 0.39, 0.03);
    EXPECT_GT(series.at("active_fraction"), 0);
    EXPECT_LE(series.at("active_fraction"), 1 - series.at("missing_fraction").get<double>() + 1e-12);
    EXPECT_EQ(series.at("bytes_dense"), 36 * 23 * 19 * 12 * 4);
    EXPECT_GT(series.at("bytes"), 0);
    ASSERT_EQ(series.at("axes").size(), 3u);
    EXPECT_EQ(series.at("axes").at(0).at("period"), 360);
    EXPECT_EQ(series.at("axes").at(2).at("negated"), true);
}

TEST_F(Info, TextHoldsTheKnownFacts) {
    const std::string text = run({"info", "ocean.vdb"}).out;
    for (const char* fact : {"ocean.vdb", "TEMP (Temperature)", "36 x 23 x 19 samples", "12 key frames",
                             "periodic (360)", "negated", "missing   40.2 %", "memory", "ocean_excerpt.nc"}) {
        EXPECT_TRUE(contains(text, fact)) << fact << " is not in\n" << text;
    }
}

/// 36 x 23 x 19 samples of which the first axis closes: 36 cells, which level 3 spans with one brick.
TEST_F(Info, StoredLevelsAreTold) {
    const Json with = Json::parse(run({"info", "ocean.vdb", "--json"}).out).at("series").at(0);
    EXPECT_EQ(with.at("levels"), 3);
    EXPECT_GT(with.at("bytes_levels"), 0);
    EXPECT_LT(with.at("bytes_levels"), with.at("bytes"));
    EXPECT_TRUE(contains(run({"info", "ocean.vdb"}).out, "levels    3 coarser ones are in the file"));

    run({"import", ISOGLASS_DATA_FOLDER "/ocean_excerpt.nc", "-o", "plain.vdb", "--variable", "TEMP",
         "--no-levels"});
    const Json without = Json::parse(run({"info", "plain.vdb", "--json"}).out).at("series").at(0);
    EXPECT_EQ(without.at("levels"), 0);
    EXPECT_EQ(without.at("bytes_levels"), 0);
    EXPECT_LT(without.at("bytes_file"), with.at("bytes_file"));
    EXPECT_FALSE(contains(run({"info", "plain.vdb"}).out, "levels"));
}

TEST_F(Info, SeveralSeriesAreListedInOrder) {
    std::filesystem::copy_file(folder_ / "ocean.vdb", folder_ / "copy.vdb");
    const Json series = Json::parse(run({"info", "copy.vdb", "ocean.vdb", "--json"}).out).at("series");
    ASSERT_EQ(series.size(), 2u);
    EXPECT_EQ(series.at(0).at("file"), "copy.vdb");
    EXPECT_EQ(series.at(1).at("file"), "ocean.vdb");
}

}  // namespace
}  // namespace isoglass::test
