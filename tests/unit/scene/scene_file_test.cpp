#include "scene/scene_file.h"

#include "base/error.h"
#include "scene/color.h"

#include <gtest/gtest.h>

#include <fstream>

namespace isoglass {
namespace {

constexpr const char* kSmallest =
    R"({"version": 1, "volumes": [{"series": "a.vdb", "surfaces": [{"iso": 2}]}]})";

/// Every key with a value that is not the default.
constexpr const char* kFull = R"({
    "$schema": "scene.schema.json",
    "version": 1,
    "volumes": [
        {"name": "storm", "series": "../data/storm.vdb", "grid": "qcloud",
         "place": {"translate": [1, 2, 3], "rotate": [0, 1, 0, 45], "scale": [1, 2, -3]},
         "time": {"offset": 5, "scale": -2}, "boundary": "closed",
         "clip": [{"plane": [1, 2, 3, 4]}, {"plane": [0, 0, -1, 2], "cap": false}],
         "surfaces": [{"iso": 0.5, "inside": "below", "color": "#E04030", "opacity": 0.3},
                      {"iso": -1e-3, "opacity": {"model": "constant", "opacity": 0.6}},
                      {"iso": 1, "opacity": {"model": "slab", "extinction": 2, "thickness": 0.1}},
                      {"iso": 2, "opacity": {"model": "slab", "extinction": 2, "iso_width": 0.3,
                                             "max_thickness": 4}},
                      {"iso": 3, "opacity": {"model": "cosine", "extinction": 10, "thickness": 0.05,
                                             "power": 0.607}},
                      {"iso": 5, "color": {"by": "series", "series": "../data/heat.vdb", "map": "cet-l3",
                                           "range": [-2, 30]}},
                      {"iso": 6, "color": {"by": "curvature", "map": "cet-d1", "range": [-1, 1]}},
                      {"iso": 7, "color": {"by": "value", "range": [9, 3]}},
                      {"iso": 8, "color": {"by": "level", "range": [0, 4]}},
                      {"iso": 4, "opacity": {"model": "iso-spectrum", "extinction": 10, "thickness": 0.05}}]},
        {"series": "/data/other.vdb", "surfaces": [{"iso": 7}]}],
    "time": {"from": "0000-01-16", "to": "0000-12-16T12:00", "duration": 12.5, "fps": 30},
    "camera": {"eye": [9, 8, 7], "target": [1, 1, 1], "up": [0, 1, 0], "fov": 40,
               "path": [{"at": 1, "eye": [5, 5, 5]}, {"at": 2.5, "target": [0, 0, 0.1]}]},
    "image": {"size": [640, 480], "background": "#ffffff", "samples": 4, "legend": false, "exposure": 1.1},
    "lighting": {"ambient": 0.1, "diffuse": 0.8, "specular": 0.2, "shininess": 20},
    "transparency": {"method": "peel", "layers": 7, "reproducible": true},
    "detail": {"error_pixels": 0.5},
    "quality": {"frame_ms": 40, "exact_order": true},
    "clip": [{"plane": [0, 1, 0, -5], "cap": true}]
})";

Scene parse(std::string_view text) {
    return parseScene(text, "scenes", "scene.json");
}

TEST(SceneFile, SmallestSceneHasDefaults) {
    const Scene scene = parse(kSmallest);
    Scene expected;
    expected.volumes.resize(1);
    expected.volumes[0].name = "a";
    expected.volumes[0].series = "scenes/a.vdb";
    expected.volumes[0].surfaces = {{.iso = 2}};
    EXPECT_EQ(scene, expected);
}

TEST(SceneFile, EveryKeyIsRead) {
    const Scene scene = parse(kFull);
    ASSERT_EQ(scene.volumes.size(), 2u);
    const Volume& storm = scene.volumes[0];
    EXPECT_EQ(storm.name, "storm");
    EXPECT_EQ(storm.series, "data/storm.vdb");
    EXPECT_EQ(storm.grid, "qcloud");
    EXPECT_EQ(storm.place, (Placement{{1, 2, 3}, {0, 1, 0, 45}, {1, 2, -3}}));
    EXPECT_EQ(storm.time, (ClockMap{5, -2}));
    EXPECT_TRUE(storm.closed);
    EXPECT_EQ(storm.clip, (std::vector<ClipPlane>{{{1, 2, 3, 4}, true}, {{0, 0, -1, 2}, false}}));
    EXPECT_EQ(scene.clip, (std::vector<ClipPlane>{{{0, 1, 0, -5}, true}}));
    ASSERT_EQ(storm.surfaces.size(), 10u);
    EXPECT_EQ(storm.surfaces[0], (Surface{0.5, Inside::below, *linearFromHex("#e04030"), 0.3f}));
    EXPECT_EQ(storm.surfaces[1], (Surface{.iso = -1e-3, .opacity = 0.6f}));
    using Model = ShellOpacity::Model;
    EXPECT_EQ(storm.surfaces[2].shell, (ShellOpacity{Model::slab, 2, 0.1f}));
    EXPECT_EQ(storm.surfaces[3].shell, (ShellOpacity{Model::slab, 2, 0, 0.3f, 4}));
    EXPECT_EQ(storm.surfaces[4].shell, (ShellOpacity{Model::cosine, 10, 0.05f, 0, 0, 0.607f}));
    EXPECT_EQ(storm.surfaces[9].shell, (ShellOpacity{Model::isoSpectrum, 10, 0.05f}));
    using By = FieldColor::By;
    EXPECT_EQ(storm.surfaces[5].fieldColor, (FieldColor{By::series, "data/heat.vdb", 2, -2, 30}));
    EXPECT_EQ(storm.surfaces[6].fieldColor, (FieldColor{By::curvature, {}, 4, -1, 1}));
    EXPECT_EQ(storm.surfaces[7].fieldColor, (FieldColor{By::value, {}, 0, 9, 3}));
    EXPECT_EQ(storm.surfaces[8].fieldColor, (FieldColor{By::level, {}, 0, 0, 4}));
    EXPECT_FALSE(scene.image.legend);
    for (const std::size_t i : {2u, 3u, 4u, 9u}) EXPECT_FALSE(storm.surfaces[i].opaque());
    EXPECT_EQ(scene.volumes[1].series, "/data/other.vdb");
    EXPECT_EQ(scene.time, (Timeline{"0000-01-16", "0000-12-16T12:00", 12.5, 30}));
    EXPECT_EQ(scene.camera.pose, (CameraPose{{9, 8, 7}, {1, 1, 1}}));
    EXPECT_EQ(scene.camera.up, glm::dvec3(0, 1, 0));
    EXPECT_EQ(scene.camera.fovDegrees, 40);
    ASSERT_EQ(scene.camera.path.size(), 2u);
    EXPECT_EQ(scene.camera.path[0], (CameraKey{1, {{5, 5, 5}, {1, 1, 1}}}));
    EXPECT_EQ(scene.camera.path[1], (CameraKey{2.5, {{9, 8, 7}, {0, 0, 0.1}}}));
    EXPECT_EQ(scene.image, (ImageSettings{{640, 480}, LinearColor(1), 1.1f, 4, 1, false}));
    EXPECT_EQ(scene.lighting, (Lighting{0.1f, 0.8f, 0.2f, 20}));
    EXPECT_EQ(scene.transparency, (Transparency{TransparencyMethod::peel, 7, true}));
    EXPECT_EQ(scene.quality, (Quality{std::nullopt, 0.5, 40, true}));
}

TEST(SceneFile, WhatChangesNothingIsNoted) {
    const Scene scene = parse(kFull);
    ASSERT_EQ(scene.notes.size(), 1u);
    EXPECT_EQ(scene.notes[0].substr(0, 8), "quality:");
}

TEST(SceneFile, PlaysBackwardsAndKeepsSecondsApartFromDates) {
    const Scene scene = parse(R"({"version": 1, "volumes": [{"series": "a.vdb", "surfaces": [{"iso": 2}]}],
                                  "time": {"from": 60, "to": -10, "duration": 1}})");
    EXPECT_EQ(scene.time.from, SceneTime(60.0));
    EXPECT_EQ(scene.time.to, SceneTime(-10.0));
}

TEST(SceneFile, EndOfTimeIsItsBeginningWhereNotGiven) {
    const Scene scene = parse(R"({"version": 1, "volumes": [{"series": "a.vdb", "surfaces": [{"iso": 2}]}],
                                  "time": {"from": "2001-02-03"}})");
    EXPECT_EQ(scene.time.to, SceneTime("2001-02-03"));
}

TEST(SceneFile, SeriesMayBeAListOrAPattern) {
    const Scene scene = parse(R"({"version": 1, "volumes": [
        {"series": ["a.vdb", "../b-*.vdb", "/c.vdb"], "surfaces": [{"iso": 2}]}]})");
    EXPECT_EQ(scene.volumes[0].series, "scenes/a.vdb");
    EXPECT_EQ(scene.volumes[0].moreSeries, (std::vector<std::filesystem::path>{"b-*.vdb", "/c.vdb"}));
    EXPECT_EQ(parseScene(toJson(scene), "", "round trip"), scene) << toJson(scene);
}

TEST(SceneFile, TransparentBackgroundIsRead) {
    for (const auto& [text, opacity] : {std::pair("transparent", 0.0f), std::pair("#ffffff33", 0.2f)}) {
        Scene scene = parse(kSmallest);
        const std::string json = R"({"version": 1, "volumes": [{"series": "a.vdb", "surfaces": [{"iso": 2}]}],
                                     "image": {"background": ")" +
                                 std::string(text) + "\"}}";
        scene.image.background = LinearColor(opacity > 0 ? 1 : 0);
        scene.image.backgroundOpacity = opacity;
        EXPECT_EQ(parse(json), scene);
        EXPECT_EQ(parseScene(toJson(scene, "scenes"), "scenes", "round trip"), scene) << toJson(scene);
    }
}

TEST(SceneFile, RoundTripThroughJsonKeepsEverything) {
    for (const char* text : {kSmallest, kFull}) {
        const Scene scene = parse(text);
        EXPECT_EQ(parseScene(toJson(scene), "", "round trip"), scene) << toJson(scene);
    }
}

TEST(SceneFile, SolidsClipWhatRaysGoThrough) {
    const auto withClip = [](const std::string& clip, const std::string& style) {
        return parse(R"({"version": 1, "volumes": [{"series": "a.vdb", "surfaces": [{"iso": 2}],
            "clip": [{"solid": "cylinder"}]}], "style": {)" +
                     style + R"(}, "clip": )" + clip + "}");
    };
    const std::string layers = R"("kind": "layers")";
    const Scene scene = withClip(R"([{"solid": "sphere", "keep": "outside", "place": {"translate": [1, 2, 3],
        "rotate": [1, 0, 0, 30], "scale": [4, 5, -6]}}, {"plane": [1, 0, 0, 0]}])",
                                 layers);
    EXPECT_EQ(scene.volumes[0].solids, std::vector{ClipSolid{.shape = SolidShape::cylinder}});
    EXPECT_EQ(scene.solids, std::vector{ClipSolid(SolidShape::sphere, Keep::outside,
                                                  {{1, 2, 3}, {1, 0, 0, 30}, {4, 5, -6}})});
    EXPECT_EQ(scene.clip.size(), 1u);
    EXPECT_EQ(parseScene(toJson(scene), "", "round trip"), scene) << toJson(scene);
    std::string many = R"({"solid": "box"})";
    for (int i = 1; i < 7; ++i) many += R"(, {"solid": "box"})";
    EXPECT_NO_THROW(withClip("[" + many + "]", layers));
    EXPECT_THROW(withClip("[" + many + R"(, {"solid": "box"}])", layers), Error);
    // A surface that stands in a shaded volume is drawn as a mesh.
    EXPECT_THROW(withClip("[]", R"("kind": "volume", "colors": [[0, "#ff0000"]], "opacities": [[0, 1]])"),
                 Error);
}

TEST(SceneFile, RaysTakeSixteenPlanes) {
    const auto withPlanes = [](int inScene, int inVolume, const std::string& style) {
        const auto planes = [](int count) {
            std::string list;
            for (int i = 0; i < count; ++i) list += std::string(i ? ", " : "") + R"({"plane": [1, 0, 0, 9]})";
            return "[" + list + "]";
        };
        return parse(R"({"version": 1, "volumes": [{"series": "a.vdb", "surfaces": [{"iso": 2}], "clip": )" +
                     planes(inVolume) + R"(}], "clip": )" + planes(inScene) + style + "}");
    };
    const std::string layers = R"(, "style": {"kind": "layers"})";
    EXPECT_EQ(withPlanes(9, 7, layers).clip.size(), 9u);
    EXPECT_THROW(withPlanes(10, 7, layers), Error);
    EXPECT_THROW(withPlanes(17, 0, layers), Error);
    EXPECT_THROW(withPlanes(0, 17, layers), Error);
    EXPECT_EQ(withPlanes(17, 7, "").clip.size(), 17u) << "meshes are cut by any number";
}

TEST(SceneFile, MeshesMayTakeThePlaceOfVolumes) {
    const Scene scene = parse(R"({"version": 1, "meshes": [
        {"file": "../data/bunny.ply"},
        {"name": "core", "file": "/data/core.stl", "place": {"translate": [1, 2, 3], "scale": [2, 2, -2]},
         "color": "#ff0000", "opacity": 0.5, "secondary": true}]})");
    MeshObject bunny{.name = "bunny", .file = "data/bunny.ply"};
    MeshObject core{.name = "core", .file = "/data/core.stl", .color = {1, 0, 0}, .opacity = 0.5f};
    core.place = {.translate = {1, 2, 3}, .scale = {2, 2, -2}};
    core.secondary = true;
    EXPECT_EQ(scene.meshes, (std::vector{bunny, core}));
    EXPECT_TRUE(scene.volumes.empty());
    EXPECT_EQ(parseScene(toJson(scene), "", "round trip"), scene);
    EXPECT_THROW(parse(R"({"version": 1, "meshes": []})"), Error);
    EXPECT_THROW(parse(R"({"version": 1, "meshes": [{"color": "#ff0000"}]})"), Error);
}

TEST(SceneFile, SurfacesMayBeSecondary) {
    const Scene scene = parse(R"({"version": 1, "volumes": [{"series": "a.vdb",
        "surfaces": [{"iso": 2}, {"iso": 3, "secondary": true}]}]})");
    EXPECT_FALSE(scene.volumes[0].surfaces[0].secondary);
    EXPECT_TRUE(scene.volumes[0].surfaces[1].secondary);
    EXPECT_EQ(parseScene(toJson(scene), "", "round trip"), scene);
}

TEST(SceneFile, WrittenPathsAreRelativeToTheFolderOfTheScene) {
    const Scene scene = parse(kFull);
    const std::string text = toJson(scene, "scenes");
    EXPECT_NE(text.find("\"../data/storm.vdb\""), std::string::npos) << text;
    EXPECT_EQ(parse(text).volumes[0].series, scene.volumes[0].series);
}

TEST(SceneFile, WrittenNumbersHaveNoRoundingTail) {
    EXPECT_NE(toJson(parse(kFull)).find("\"opacity\": 0.3,\n"), std::string::npos) << toJson(parse(kFull));
}

TEST(SceneFile, LoadsRelativeToItsOwnFolder) {
    const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "isoglass_scene_file";
    std::filesystem::create_directories(folder);
    std::ofstream(folder / "s.json") << kSmallest;
    EXPECT_EQ(loadScene(folder / "s.json").volumes[0].series, folder / "a.vdb");
    std::filesystem::remove_all(folder);
}

TEST(SceneFile, FileThatCannotBeReadIsNamed) {
    for (const char* file : {"/nowhere/scene.json", "/"}) {
        try {
            loadScene(file);
            FAIL() << "no error for " << file;
        } catch (const Error& error) {
            EXPECT_EQ(error.where(), file);
        }
    }
}

}  // namespace
}  // namespace isoglass
