#include "app/app_test.h"

#include <nlohmann/json.hpp>

#include <sstream>

namespace isoglass::test {
namespace {

using Json = nlohmann::json;

class Plan : public AppTest {};

TEST_F(Plan, JsonNamesEveryPassWithItsReason) {
    importOcean();
    writeScene();
    const Json plan = Json::parse(run({"plan", "scene.json", "--json"}).out);
    ASSERT_FALSE(plan.at("passes").empty());
    ASSERT_FALSE(plan.at("left_out").empty());
    for (const char* list : {"passes", "left_out"}) {
        for (const Json& pass : plan.at(list)) {
            EXPECT_FALSE(pass.at("pass").get<std::string>().empty());
            EXPECT_FALSE(pass.at("reason").get<std::string>().empty());
        }
    }
}

TEST_F(Plan, TextSaysTheSameAsJson) {
    importOcean();
    writeScene();
    const std::string text = run({"plan", "scene.json"}).out;
    const Json plan = Json::parse(run({"plan", "scene.json", "--json"}).out);
    for (const char* list : {"passes", "left_out"}) {
        for (const Json& pass : plan.at(list)) {
            const std::string line =
                pass.at("pass").get<std::string>() + ": " + pass.at("reason").get<std::string>();
            EXPECT_TRUE(contains(text, line)) << line;
        }
    }
}

std::set<std::string> passesOf(const std::string& json) {
    std::set<std::string> names;
    const Json plan = Json::parse(json);
    for (const Json& pass : plan.at("passes")) names.insert(pass.at("pass"));
    return names;
}

TEST_F(Plan, OnlyTheFourPassMethodNeedsBackFaceDepth) {
    importOcean();
    writeScene(R"("transparency": {"method": "3-pass"},)", "three.json");
    writeScene(R"("transparency": {"method": "4-pass"},)", "four.json");
    EXPECT_FALSE(passesOf(run({"plan", "three.json", "--json"}).out).contains("back-face depth"));
    EXPECT_TRUE(passesOf(run({"plan", "four.json", "--json"}).out).contains("back-face depth"));
}

/// The scene begins at the time of the ocean's first key frame.
TEST_F(Plan, SaysWhatIsReadAndExtractedAndHowLongThePassesTake) {
    importOcean();
    writeScene();
    const Json plan = Json::parse(run({"plan", "scene.json", "--json"}).out);
    EXPECT_EQ(plan.at("method"), "4-pass");
    EXPECT_EQ(plan.at("work").size(), 4u) << "a key frame and three surfaces";
    ASSERT_EQ(plan.at("work_left_out").size(), 2u);
    EXPECT_EQ(plan.at("work_left_out")[0].at("work"), "second key frame");
    EXPECT_EQ(plan.at("work_left_out")[1].at("work"), "samples");
    for (const Json& pass : plan.at("passes")) EXPECT_GE(pass.at("milliseconds"), 0) << pass;
    const std::string clock = plan.at("clock");
    EXPECT_TRUE(clock == "GPU timer query" || clock == "serial wall clock") << clock;
}

TEST_F(Plan, SaysThatLayersTakeSamplesAndAPassOfTheirOwn) {
    importOcean();
    std::ofstream(folder_ / "layers.json")
        << R"({"version": 1, "volumes": [{"series": "ocean.vdb", "surfaces": [{"iso": 15}]}],
        "image": {"size": [64, 48]}, "style": {"kind": "layers"}})";
    const Json plan = Json::parse(run({"plan", "layers.json", "--json"}).out);
    const auto names = [&](const char* list, const char* key) {
        std::set<std::string> found;
        for (const Json& item : plan.at(list)) found.insert(item.at(key).get<std::string>());
        return found;
    };
    EXPECT_EQ(names("work", "work"),
              (std::set<std::string>{"first key frame", "second key frame", "samples"}));
    EXPECT_TRUE(names("passes", "pass").contains("layers"));
    EXPECT_TRUE(names("left_out", "pass").contains("opaque"));
}

class Bench : public AppTest {};

TEST_F(Bench, PrintsALineOfJson) {
    const RunResult result =
        run({"bench", "extract-blobs/64", "--json", "--repetitions", "3", "--threads", "1"});
    std::istringstream lines(result.out);
    std::string line;
    ASSERT_TRUE(std::getline(lines, line)) << result.out;
    const Json json = Json::parse(line);
    EXPECT_EQ(json.at("name"), "extract-blobs");
    EXPECT_EQ(json.at("size"), 64);
    EXPECT_EQ(json.at("threads"), 1);
    EXPECT_GT(json.at("median_ms"), 0);
    EXPECT_GT(json.at("triangles"), 1000);
    EXPECT_GT(json.at("peak_rss_mb"), 0);
    EXPECT_FALSE(std::getline(lines, line)) << "one benchmark has this name, but there is also " << line;
}

}  // namespace
}  // namespace isoglass::test
