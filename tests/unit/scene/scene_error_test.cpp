#include "base/error.h"
#include "scene/scene_file.h"
#include "scene/scene_format.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <string>

namespace isoglass {
namespace {

using nlohmann::json;

json smallest() {
    return json::parse(R"({"version": 1, "volumes": [{"series": "a.vdb", "surfaces": [{"iso": 2}]}]})");
}

/// The smallest scene with one value put in or replaced.
std::string sceneWith(const std::string& pointer, const json& value) {
    json scene = smallest();
    scene[json::json_pointer(pointer)] = value;
    return scene.dump();
}

std::string messageOf(std::string_view text) {
    try {
        parseScene(text, "", "scene.json");
    } catch (const Error& error) {
        return error.what();
    }
    return "no error";
}

struct Wrong {
    const char* pointer;      ///< where the value goes
    const char* value;        ///< as JSON
    const char* complaintAt;  ///< pointer that the message must name; null for `pointer`
    const char* says;

    friend void PrintTo(const Wrong& wrong, std::ostream* stream) {
        *stream << wrong.pointer << ' ' << wrong.value;
    }
};

class SceneErrors : public testing::TestWithParam<Wrong> {};

TEST_P(SceneErrors, NamePlaceAndReason) {
    const Wrong& wrong = GetParam();
    const std::string message = messageOf(sceneWith(wrong.pointer, json::parse(wrong.value)));
    const std::string place = wrong.complaintAt ? wrong.complaintAt : wrong.pointer;
    EXPECT_NE(message.find("(scene.json, " + place + ")"), std::string::npos) << message;
    EXPECT_NE(message.find(wrong.says), std::string::npos) << message;
}

constexpr const char* kSeries = "/volumes/0/series";
constexpr const char* kOpacity = "/volumes/0/surfaces/0/opacity";

INSTANTIATE_TEST_SUITE_P(
    Values, SceneErrors,
    testing::Values(
        Wrong{"/version", "2", nullptr, "expected a whole number from 1 to 1, found 2"},
        Wrong{"/version", "\"1\"", nullptr, "found \"1\""},
        Wrong{"/volumes", "[]", nullptr, "at least one volume"},
        Wrong{"/volumes", "{}", nullptr, "expected an array, found an empty object"},
        Wrong{"/volumes/0", "7", nullptr, "expected an object, found 7"},
        Wrong{"/volumes/0/name", "7", nullptr, "expected a text"},
        Wrong{kSeries, "\"\"", nullptr, "expected the path"},
        Wrong{kSeries, "[]", nullptr, "at least one file"},
        Wrong{kSeries, R"(["a.vdb", 7])", "/volumes/0/series/1", "expected the path"},
        Wrong{kSeries, R"("*/a.vdb")", nullptr, "a pattern stands in the name of a folder"},
        Wrong{"/volumes/0/grid", "[]", nullptr, "expected a text, found an array of 0"},
        Wrong{"/volumes/0/surfaces", "[]", nullptr, "at least one surface"},
        Wrong{"/volumes/0/surfaces/0/iso", "\"high\"", nullptr, "expected a number, found \"high\""},
        Wrong{"/volumes/0/surfaces/0/inside", "\"bellow\"", nullptr, "did you mean \"below\"?"},
        Wrong{"/volumes/0/surfaces/0/color", "\"#fff\"", nullptr, "\"#rrggbb\""},
        Wrong{kOpacity, "1.5", nullptr, "at least 0 and of at most 1, found 1.5"},
        Wrong{kOpacity, "-0.1", nullptr, "found -0.1"},
        Wrong{kOpacity, R"({"model": "cosin", "opacity": 1})", "/volumes/0/surfaces/0/opacity/model",
              "\"cosine\"?"},
        Wrong{kOpacity, R"({"model": "constant"})", "/volumes/0/surfaces/0/opacity/opacity", "missing"},
        Wrong{"/volumes/0/surfaces/0/color", R"({"by": "heat", "range": [0, 1]})",
              "/volumes/0/surfaces/0/color/by", "one of series, value, curvature, level"},
        Wrong{"/volumes/0/surfaces/0/color", R"({"by": "value", "range": [1, 1]})",
              "/volumes/0/surfaces/0/color/range", "two different numbers"},
        Wrong{"/volumes/0/surfaces/0/color", R"({"by": "value", "range": [0, 1], "map": "jet"})",
              "/volumes/0/surfaces/0/color/map", "viridis"},
        Wrong{"/volumes/0/surfaces/0/color", R"({"by": "value", "range": [0, 1], "series": "a.vdb"})",
              "/volumes/0/surfaces/0/color/series", "does not belong to a colour by \"value\""},
        Wrong{"/volumes/0/surfaces/0/color", R"({"by": "series", "range": [0, 1]})",
              "/volumes/0/surfaces/0/color/series", "missing"},
        Wrong{"/volumes/0/surfaces/0/color", R"({"by": "curvature"})", "/volumes/0/surfaces/0/color/range",
              "missing"},
        Wrong{kOpacity, R"({"opacity": 1})", "/volumes/0/surfaces/0/opacity/model", "missing"},
        Wrong{kOpacity, R"({"model": "constant", "opacity": 1, "power": 2})",
              "/volumes/0/surfaces/0/opacity/power", "does not belong to the model \"constant\""},
        Wrong{kOpacity, R"({"model": "slab", "extinction": 1, "thickness": 1, "iso_width": 1})",
              "/volumes/0/surfaces/0/opacity/iso_width", "leaves nothing to the gradient"},
        Wrong{kOpacity, R"({"model": "slab", "extinction": 1, "iso_width": 1})",
              "/volumes/0/surfaces/0/opacity/max_thickness", "missing"},
        Wrong{kOpacity, R"({"model": "slab", "extinction": 0, "thickness": 1})",
              "/volumes/0/surfaces/0/opacity/extinction", "at least 1e-12"},
        Wrong{kOpacity, R"({"model": "cosine", "extinction": 10, "thickness": 1})",
              "/volumes/0/surfaces/0/opacity/thickness", "below 1"},
        Wrong{kOpacity, R"({"model": "iso-spectrum", "extinction": 10})",
              "/volumes/0/surfaces/0/opacity/thickness", "missing"},
        Wrong{"/volumes/0/place/translate", "[1, 2]", nullptr, "array of 3 numbers, found an array of 2"},
        Wrong{"/volumes/0/place/translate", "[1, 2, null]", "/volumes/0/place/translate/2", "found null"},
        Wrong{"/volumes/0/place/rotate", "[0, 0, 0, 90]", nullptr, "not zero"},
        Wrong{"/volumes/0/place/scale", "[1, 0, 1]", "/volumes/0/place/scale/1", "other than 0"},
        Wrong{"/volumes/0/time/scale", "true", nullptr, "found true"},
        Wrong{"/volumes/0/boundary", "\"shut\"", nullptr, "one of open, closed"},
        Wrong{"/time/from", "\"2001-13-01\"", nullptr, "YYYY-MM-DD"},
        Wrong{"/time", R"({"from": 0, "to": "2001-01-01"})", "/time/to", "both seconds or both dates"},
        Wrong{"/time/duration", "-1", nullptr, "at least 0"},
        Wrong{"/time/duration", "1e12", nullptr, "1e9 displayed frames"},
        Wrong{"/time/fps", "0", nullptr, "above 0"},
        Wrong{"/camera", R"({"eye": [1, 1, 1], "target": [1, 1, 1]})", nullptr, "the eye is at the target"},
        Wrong{"/camera", R"({"eye": [0, 0, 5], "target": [0, 0, 0]})", nullptr, "along \"up\""},
        Wrong{"/camera/up", "[0, 0, 0]", nullptr, "length 0"},
        Wrong{"/camera/fov", "180", nullptr, "below 180"}, Wrong{"/camera/fov", "0", nullptr, "above 0"},
        Wrong{"/camera/path", R"([{"at": 1}, {"at": 1, "eye": [9, 0, 0]}])", "/camera/path/1/at", "later"},
        Wrong{"/camera/path", R"([{"at": 1}, {"at": 2, "eye": [0, 0, 9]}])", "/camera/path/1",
              "along \"up\""},
        Wrong{"/camera/path", R"([{"eye": [9, 0, 0]}])", "/camera/path/0/at", "missing"},
        Wrong{"/image/size", "[0, 10]", "/image/size/0", "from 1 to 16384"},
        Wrong{"/image/size", "[10, 16385]", "/image/size/1", "from 1 to 16384"},
        Wrong{"/image/size", "[10.5, 10]", "/image/size/0", "whole number"},
        Wrong{"/image/size", "[10]", nullptr, "[width, height]"},
        Wrong{"/image/background", "16", nullptr, "\"#rrggbb\" or \"#rrggbbaa\", found 16"},
        Wrong{"/image/background", "\"#10203g40\"", nullptr, "\"transparent\" or an sRGB colour"},
        Wrong{"/image/background", "\"#102030405\"", nullptr, "\"transparent\" or an sRGB colour"},
        Wrong{"/image/exposure", "0", nullptr, "at least 1e-06"},
        Wrong{"/lighting/ambient", "2", nullptr, "at most 1"},
        Wrong{"/lighting/shininess", "0", nullptr, "at least 1"},
        Wrong{"/image/samples", "65", nullptr, "from 1 to 64"},
        Wrong{"/clip", R"([{"plane": [0, 0, 0, 1]}])", "/clip/0/plane", "normal that is not zero"},
        Wrong{"/clip", R"([{"plane": [1, 0, 0]}])", "/clip/0/plane", "4"},
        Wrong{"/clip", R"([{"plane": [1, 0, 0, 0]}, {}])", "/clip/1/plane", "missing"},
        Wrong{"/volumes/0/clip", R"([{"plane": [1, 0, 0, 0], "cap": 1}])", "/volumes/0/clip/0/cap",
              "true or false"},
        Wrong{"/clip", R"([{"solid": "ball"}])", "/clip/0/solid", "one of box, sphere, cylinder"},
        Wrong{"/clip", R"([{"solid": "box", "plane": [1, 0, 0, 0]}])", "/clip/0/plane", "does not belong"},
        Wrong{"/clip", R"([{"solid": "box", "cap": true}])", "/clip/0/cap", "does not belong"},
        Wrong{"/clip", R"([{"plane": [1, 0, 0, 0], "keep": "inside"}])", "/clip/0/keep", "does not belong"},
        Wrong{"/clip", R"([{"solid": "box", "keep": "left"}])", "/clip/0/keep", "one of inside, outside"},
        Wrong{"/clip", R"([{"solid": "box", "place": {"scale": [1, 0, 1]}}])", "/clip/0/place/scale/1",
              "other than 0"},
        Wrong{"/transparency/method", "\"5-pass\"", nullptr, "did you mean"},
        Wrong{"/transparency/layers", "4", nullptr, "belongs to the method \"peel\""},
        Wrong{"/transparency", R"({"method": "peel", "layers": 0})", "/transparency/layers", "from 1 to 256"},
        Wrong{"/transparency", R"({"method": "2-pass", "reproducible": true})", "/transparency/reproducible",
              "depends on the order"},
        Wrong{"/transparency/reproducible", "1", nullptr, "true or false"},
        Wrong{"/quality/exact_order", "1", nullptr, "true or false"},
        Wrong{"/detail", R"({"pixels": 1, "error_pixels": 1})", "/detail/error_pixels", "exclude each other"},
        Wrong{"/detail/pixels", "0", nullptr, "above 0"},
        Wrong{"/quality/frame_ms", "-1", nullptr, "above 0"}));

INSTANTIATE_TEST_SUITE_P(NotAvailable, SceneErrors,
                         testing::Values(Wrong{"/volumes/0/clip", R"([{"mesh": "bunny.ply"}])",
                                               "/volumes/0/clip/0/mesh", "not available in this version"},
                                         Wrong{"/clip", R"([{"mesh": "bunny.ply"}])", "/clip/0/mesh",
                                               "not available in this version"},
                                         Wrong{"/clip", R"([{"plane": [1, 0, 0, 0]}, {"solid": "box"}])",
                                               "/clip/1", "clipping surfaces by a solid"},
                                         Wrong{"/volumes/0/clip", R"([{"solid": "box"}])",
                                               "/volumes/0/clip/0", "clipping surfaces by a solid"},
                                         Wrong{"/terrain", "{}", nullptr, "not available in this version"},
                                         Wrong{"/ocean", "{}", nullptr, "not available in this version"},
                                         Wrong{"/sky", "{}", nullptr, "not available in this version"}));

INSTANTIATE_TEST_SUITE_P(
    Styles, SceneErrors,
    testing::Values(
        Wrong{"/style", "{}", "/style/kind", "missing"},
        Wrong{"/style", R"({"kind": "layer"})", "/style/kind", "layers"},
        Wrong{"/style", R"({"kind": "layers", "volume": "none"})", "/style/volume", "no volume"},
        Wrong{"/style", R"({"kind": "layers", "count": 0})", "/style/count", "1 to 16"},
        Wrong{"/style", R"({"kind": "layers", "count": 17})", "/style/count", "1 to 16"},
        Wrong{"/style", R"({"kind": "layers", "count": 2, "first": 3})", "/style/first", "1 to 2"},
        Wrong{"/style", R"({"kind": "layers", "show": "nth", "first": 1})", "/style/first", "alone"},
        Wrong{"/style", R"({"kind": "layers", "colors": []})", "/style/colors", "1 to 16"},
        Wrong{"/style", R"({"kind": "layers", "colors": ["red"]})", "/style/colors/0", "sRGB"},
        Wrong{"/style", R"({"kind": "layers", "opacities": [2]})", "/style/opacities/0", "at most 1"},
        Wrong{"/style", R"({"kind": "layers", "show": "nth", "opacities": [1]})", "/style/opacities",
              "composed"},
        Wrong{"/style", R"({"kind": "layers", "silhouette": 0.5})", "/style/silhouette", "silhouettes"},
        Wrong{"/style", R"({"kind": "layers", "step": 0})", "/style/step", "number"},
        Wrong{"/style", R"({"kind": "layers", "steps": 1})", "/style/steps", "step"}));

INSTANTIATE_TEST_SUITE_P(
    UnknownKeys, SceneErrors,
    testing::Values(Wrong{"/colour", "1", nullptr, "unknown key \"colour\""},
                    Wrong{"/volumes/0/surfaces/0/colour", "1", nullptr, "did you mean \"color\"?"},
                    Wrong{"/image/szie", "1", nullptr, "did you mean \"size\"?"},
                    Wrong{"/time/frmo", "1", nullptr, "Known here: from, to, duration, fps"},
                    Wrong{"/a~1b~0c", "1", nullptr, "\"a/b~c\""}));

TEST(SceneErrors, EveryKnownKeyIsLookedAt) {
    for (const FormatObject& object : sceneFormat()) {
        std::string pointer(object.pointer);
        for (std::size_t star; (star = pointer.find('*')) != std::string::npos;)
            pointer.replace(star, 1, "0");
        for (const std::string_view key : object.keys) {
            std::string place = pointer;
            place.append("/").append(key);
            json scene = smallest();
            if (object.pointer.ends_with("/opacity"))
                scene[json::json_pointer(pointer)] = {{"model", "constant"}, {"opacity", 1}};
            if (object.pointer == "/camera/path/*") scene[json::json_pointer(pointer)] = {{"at", 0}};
            if (object.pointer == "/camera/path/*") scene["camera"]["eye"] = {3, 2, 1};
            if (object.pointer.starts_with("/meshes/*")) scene["meshes"][0]["file"] = "a.ply";
            if (object.pointer == "/style") scene["style"] = {{"kind", "layers"}};
            if (object.pointer == "/style/cut") {
                scene["style"] = json::parse(R"({"kind": "volume", "colors": [[0, "#ff0000"]],
                    "opacities": [[0, 1]], "cut": {"thickness": 1}})");
            }
            if (object.pointer.ends_with("/clip/*/place"))
                scene[json::json_pointer(pointer).parent_pointer()]["solid"] = "box";
            scene[json::json_pointer(place)] = nullptr;
            const std::string message = messageOf(scene.dump());
            EXPECT_NE(message.find("(scene.json, " + place + ")"), std::string::npos) << message;
            EXPECT_EQ(message.find("unknown key"), std::string::npos) << message;
        }
    }
}

TEST(SceneErrors, MissingKeysAreNamed) {
    for (const char* place :
         {"/version", "/volumes", "/volumes/0/series", "/volumes/0/surfaces", "/volumes/0/surfaces/0/iso"}) {
        const json::json_pointer pointer(place);
        json scene = smallest();
        scene[pointer.parent_pointer()].erase(pointer.back());
        const std::string message = messageOf(scene.dump());
        EXPECT_NE(message.find("(scene.json, " + std::string(place) + ")"), std::string::npos) << message;
    }
}

TEST(SceneErrors, RootMustBeAnObject) {
    EXPECT_NE(messageOf("[]").find("expected an object"), std::string::npos);
}

TEST(SceneErrors, SyntaxErrorsHaveLineAndColumn) {
    // The comma after 1 is missing: the parser stumbles over the quote at the start of line 3.
    const std::string message = messageOf("{\"version\": 1\n\n\"volumes\": []}");
    EXPECT_NE(message.find("(scene.json, line 3, column "), std::string::npos) << message;
    EXPECT_NE(message.find("expected"), std::string::npos) << message;
    EXPECT_EQ(message.find("json.exception"), std::string::npos) << message;
    EXPECT_EQ(message.find("at line"), std::string::npos) << message;
}

TEST(SceneErrors, NumbersThatAreNotFiniteAreRefused) {
    for (const char* number : {"NaN", "Infinity", "1e999", "-1e999"}) {
        const std::string text =
            std::string(R"({"version": 1, "volumes": [{"series": "a.vdb", "surfaces": [{"iso": )") + number +
            "}]}]}";
        EXPECT_NE(messageOf(text).find("(scene.json, line 1, column "), std::string::npos) << messageOf(text);
    }
}

TEST(SceneErrors, EmptyAndTruncatedTextsAreRefused) {
    const std::string whole = smallest().dump();
    for (std::size_t length = 0; length < whole.size(); ++length) {
        EXPECT_NE(messageOf(whole.substr(0, length)).find("(scene.json, line 1, column "), std::string::npos)
            << length;
    }
}

TEST(SceneErrors, RepeatedKeyIsNamed) {
    const std::string message = messageOf(
        R"({"version": 1, "volumes": [{"series": "a.vdb", "surfaces": [{"iso": 2}, {"iso": 1, "iso": 2}]}]})");
    EXPECT_NE(message.find("\"iso\" appears twice (scene.json, /volumes/0/surfaces/1/iso)"),
              std::string::npos)
        << message;
}

TEST(ClosestWord, CountsEdits) {
    constexpr std::string_view kWords[] = {"size", "samples", "exposure"};
    EXPECT_EQ(closestWord("sample", kWords), "samples");
    EXPECT_EQ(closestWord("Exposure", kWords), "exposure");
    EXPECT_EQ(closestWord("", kWords), "size");
}

}  // namespace
}  // namespace isoglass
