#include "scene/scene_check.h"

#include "scene/scene_file.h"
#include "scene/scene_format.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <string>

namespace isoglass {
namespace {

using nlohmann::json;

json smallest() {
    return json::parse(R"({"version": 1, "volumes": [{"series": "a.vdb", "surfaces": [{"iso": 2}]}]})");
}

SceneProblems check(const json& scene) {
    return checkScene(scene.dump(), "", "scene.json");
}

std::vector<std::string> places(const SceneProblems& problems) {
    std::vector<std::string> list;
    for (const Error& error : problems.errors) list.push_back(error.where());
    return list;
}

using List = std::vector<std::string>;

TEST(SceneCheck, AGoodSceneIsWhatTheReaderReads) {
    const SceneProblems problems = check(smallest());
    EXPECT_EQ(places(problems), List{});
    EXPECT_EQ(problems.rest, parseScene(smallest().dump(), "", "scene.json"));
    EXPECT_TRUE(problems.replaced.empty());
}

TEST(SceneCheck, AnErrorDoesNotHideTheNext) {
    json scene = smallest();
    scene["version"] = 3;
    scene["volumes"][0]["surfaces"][0].erase("iso");
    scene["volumes"][0]["surfaces"][0]["opacity"] = "half";
    scene["time"]["fps"] = 0;
    scene["time"]["rate"] = 7;
    const SceneProblems problems = check(scene);
    EXPECT_EQ(places(problems), (List{"scene.json, /version", "scene.json, /volumes/0/surfaces/0/iso",
                                      "scene.json, /volumes/0/surfaces/0/opacity", "scene.json, /time/rate",
                                      "scene.json, /time/fps"}));
    ASSERT_TRUE(problems.rest);
    EXPECT_EQ(problems.rest->volumes[0].series, "a.vdb");
    EXPECT_TRUE(problems.touches("/volumes/0/surfaces/0/iso"));
    EXPECT_TRUE(problems.touches("/volumes/0/surfaces")) << "holds a replaced value";
    EXPECT_FALSE(problems.touches("/volumes/0/series"));
    EXPECT_FALSE(problems.touches("/vol"));
}

/// Whatever one value is wrong, every other error is found too, and it ends.
TEST(SceneCheck, OneWrongValueAnywhereLeavesTheOthersFound) {
    for (const FormatObject& object : sceneFormat()) {
        std::string pointer(object.pointer);
        for (std::size_t star; (star = pointer.find('*')) != std::string::npos;)
            pointer.replace(star, 1, "0");
        for (const std::string_view key : object.keys) {
            json scene = smallest();
            if (object.pointer == "/camera/path/*") scene[json::json_pointer(pointer)] = {{"at", 0}};
            scene[json::json_pointer(pointer + "/" + std::string(key))] = nullptr;
            scene["zzz"] = 1;
            const List found = places(check(scene));
            EXPECT_GE(found.size(), 2u) << pointer << '/' << key;
            EXPECT_TRUE(std::ranges::find(found, "scene.json, /zzz") != found.end()) << pointer << '/' << key;
        }
    }
}

/// The volume of a medium has no surfaces; it is not blamed for that where the medium is wrong.
TEST(SceneCheck, AWrongStyleInventsNoOtherError) {
    json scene = smallest();
    scene["volumes"][0].erase("surfaces");
    scene["style"] = {{"kind", "volume"}, {"colors", {{1, "red"}}}, {"opacities", {{2, 0.5}, {1, 0.5}}}};
    EXPECT_EQ(places(check(scene)),
              (List{"scene.json, /style/colors/0/1", "scene.json, /style/opacities/1/0"}));
}

TEST(SceneCheck, WhatIsNoObjectHasOneError) {
    EXPECT_EQ(places(check(json::array())), List{"scene.json"});
    EXPECT_EQ(places(checkScene("{", "", "scene.json")).size(), 1u);
    EXPECT_FALSE(check(json::array()).rest);
}

TEST(SceneCheck, EndsOnASceneOfErrors) {
    json scene = smallest();
    for (int i = 0; i < 1000; ++i) scene["key" + std::to_string(i)] = i;
    EXPECT_EQ(check(scene).errors.size(), 100u);
}

}  // namespace
}  // namespace isoglass
