#include "scene/scene_file.h"

#include "base/error.h"
#include "scene/clip_json.h"
#include "scene/color.h"
#include "scene/color_json.h"
#include "scene/iso_date.h"
#include "scene/json_document.h"
#include "scene/json_node.h"
#include "scene/opacity_json.h"
#include "scene/placement_json.h"
#include "scene/scene_format.h"
#include "scene/style_json.h"
#include "scene/transparency.h"

#include <glm/geometric.hpp>

#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <optional>

namespace isoglass {

namespace {

using Word = std::string_view;

constexpr NumberRange kPositive{.low = 0, .openLow = true};
constexpr NumberRange kNotNegative{.low = 0};
constexpr NumberRange kShare{.low = 0, .high = 1};
constexpr double kMostFrames = 1e9;
constexpr int kLargestImage = 16384;

Surface readSurface(const JsonNode& node, const std::filesystem::path& baseFolder) {
    node.object();
    Surface surface;
    surface.iso = node.require("iso").number();
    if (const auto inside = node.find("inside")) {
        constexpr std::array kSides{Word("above"), Word("below")};
        surface.inside = inside->choice(kSides) == 0 ? Inside::above : Inside::below;
    }
    if (const auto color = node.find("color")) readSurfaceColor(*color, baseFolder, surface);
    if (const auto opacity = node.find("opacity")) readOpacity(*opacity, surface);
    if (const auto secondary = node.find("secondary")) surface.secondary = secondary->boolean();
    return surface;
}

ClockMap readClock(const JsonNode& node) {
    node.object();
    ClockMap clock;
    if (const auto offset = node.find("offset")) clock.offset = offset->number();
    if (const auto scale = node.find("scale")) clock.scale = scale->number();
    return clock;
}

std::filesystem::path readSeriesPath(const JsonNode& node, const std::filesystem::path& baseFolder) {
    if (!node.value().is_string() || node.text().empty()) node.failExpected("the path of a series");
    const std::filesystem::path path = (baseFolder / node.text()).lexically_normal();
    if (std::filesystem::path(node.text()).parent_path().string().find_first_of("*?") != std::string::npos) {
        node.fail("a pattern stands in the name of a folder", "put * and ? into the name of the file");
    }
    return path;
}

void readSeries(const JsonNode& node, const std::filesystem::path& baseFolder, Volume& volume) {
    if (!node.value().is_array()) {
        volume.series = readSeriesPath(node, baseFolder);
        return;
    }
    if (node.size() == 0) node.fail("expected at least one file, found none");
    volume.series = readSeriesPath(node.item(0), baseFolder);
    for (std::size_t i = 1; i < node.size(); ++i)
        volume.moreSeries.push_back(readSeriesPath(node.item(i), baseFolder));
}

/// Without surfaces only a volume of the style "volume" shows something.
void readSurfaces(const JsonNode& node, const std::filesystem::path& baseFolder, bool mayBeEmpty,
                  Volume& volume) {
    const auto surfaces = mayBeEmpty ? node.find("surfaces") : std::optional(node.require("surfaces"));
    if (!surfaces) return;
    if (surfaces->size() == 0 && !mayBeEmpty) surfaces->fail("expected at least one surface, found none");
    for (std::size_t i = 0; i < surfaces->size(); ++i)
        volume.surfaces.push_back(readSurface(surfaces->item(i), baseFolder));
}

Volume readVolume(const JsonNode& node, const std::filesystem::path& baseFolder, bool surfacesMayBeEmpty) {
    node.object();
    Volume volume;
    readSeries(node.require("series"), baseFolder, volume);
    const auto name = node.find("name");
    volume.name = name ? name->text() : volume.series.stem().string();
    if (const auto grid = node.find("grid")) volume.grid = grid->text();
    if (const auto place = node.find("place")) volume.place = readPlacement(*place);
    if (const auto time = node.find("time")) volume.time = readClock(*time);
    if (const auto boundary = node.find("boundary")) {
        constexpr std::array kBoundaries{Word("open"), Word("closed")};
        volume.closed = boundary->choice(kBoundaries) == 1;
    }
    if (const auto clip = node.find("clip")) readClip(*clip, volume.clip, volume.solids);
    readSurfaces(node, baseFolder, surfacesMayBeEmpty, volume);
    return volume;
}

MeshObject readMeshObject(const JsonNode& node, const std::filesystem::path& baseFolder) {
    node.object();
    MeshObject mesh;
    const JsonNode file = node.require("file");
    if (file.text().empty()) file.failExpected("the path of a mesh: .ply, .obj, .stl or .off");
    mesh.file = (baseFolder / file.text()).lexically_normal();
    const auto name = node.find("name");
    mesh.name = name ? name->text() : mesh.file.stem().string();
    if (const auto place = node.find("place")) mesh.place = readPlacement(*place);
    if (const auto color = node.find("color")) mesh.color = readColor(*color);
    if (const auto opacity = node.find("opacity")) mesh.opacity = static_cast<float>(opacity->number(kShare));
    if (const auto secondary = node.find("secondary")) mesh.secondary = secondary->boolean();
    return mesh;
}

SceneTime readTime(const JsonNode& node) {
    if (node.value().is_number()) return node.number();
    if (!node.value().is_string() || !isIsoDate(node.text())) {
        node.failExpected(
            "seconds, or a date \"YYYY-MM-DD\", \"YYYY-MM-DDTHH:MM\" or \"YYYY-MM-DDTHH:MM:SS\"");
    }
    return node.text();
}

Timeline readTimeline(const JsonNode& node) {
    node.object();
    Timeline time;
    const auto to = node.find("to");
    if (const auto from = node.find("from")) time.from = readTime(*from);
    time.to = to ? readTime(*to) : time.from;
    if (time.from.index() != time.to.index()) {
        to->failExpected("the same kind as \"from\": both seconds or both dates");
    }
    if (const auto fps = node.find("fps")) time.fps = fps->number(kPositive);
    if (const auto duration = node.find("duration")) {
        time.duration = duration->number(kNotNegative);
        if (!(time.duration * time.fps <= kMostFrames))
            duration->failExpected("at most 1e9 displayed frames");
    }
    return time;
}

void checkPose(const JsonNode& node, const CameraPose& pose, glm::dvec3 up) {
    // Directions closer than this have no usable cross product left in single precision.
    constexpr double kSmallestSine = 1e-6;
    const glm::dvec3 view = pose.target - pose.eye;
    const double distance = glm::length(view);
    if (distance == 0) node.fail("the eye is at the target", "move one of the two");
    if (!std::isfinite(distance)) node.fail("the eye is too far from the target");
    const double sine = glm::length(glm::cross(glm::normalize(view), glm::normalize(up)));
    if (!(sine > kSmallestSine)) {
        node.fail("the camera looks along \"up\"",
                  "choose another up, such as [0,1,0] for a view from above");
    }
}

CameraPose readPose(const JsonNode& node, CameraPose pose) {
    if (const auto eye = node.find("eye")) pose.eye = eye->vector();
    if (const auto target = node.find("target")) pose.target = target->vector();
    return pose;
}

void readPath(const JsonNode& node, Camera& camera) {
    for (std::size_t i = 0; i < node.size(); ++i) {
        const JsonNode item = node.item(i);
        item.object();
        const JsonNode at = item.require("at");
        const CameraKey key{at.number(kNotNegative), readPose(item, camera.pose)};
        if (i > 0 && !(key.at > camera.path.back().at))
            at.failExpected("a later time than that of the key before");
        checkPose(item, key.pose, camera.up);
        camera.path.push_back(key);
    }
}

Camera readCamera(const JsonNode& node) {
    node.object();
    Camera camera;
    camera.pose = readPose(node, camera.pose);
    if (const auto up = node.find("up")) {
        camera.up = up->vector();
        const double length = glm::length(camera.up);
        if (!(length > 0) || !std::isfinite(length))
            up->fail("expected a direction, found a vector of length 0 or too large");
    }
    if (const auto fov = node.find("fov")) {
        camera.fovDegrees = fov->number({.low = 0, .high = 180, .openLow = true, .openHigh = true});
    }
    if (const auto path = node.find("path")) readPath(*path, camera);
    if (camera.path.empty()) checkPose(node, camera.pose, camera.up);
    return camera;
}

void readBackground(const JsonNode& node, ImageSettings& image) {
    const auto backdrop = node.value().is_string() ? backdropFromText(node.text()) : std::nullopt;
    if (!backdrop) node.failExpected("\"transparent\" or an sRGB colour \"#rrggbb\" or \"#rrggbbaa\"");
    image.background = backdrop->color;
    image.backgroundOpacity = backdrop->opacity;
}

ImageSettings readImage(const JsonNode& node) {
    node.object();
    ImageSettings image;
    if (const auto size = node.find("size")) {
        if (size->size() != 2) size->failExpected("[width, height]");
        image.size = {size->item(0).integer(1, kLargestImage), size->item(1).integer(1, kLargestImage)};
    }
    if (const auto background = node.find("background")) readBackground(*background, image);
    if (const auto legend = node.find("legend")) image.legend = legend->boolean();
    if (const auto samples = node.find("samples")) image.samples = samples->integer(1, kMostSamples);
    if (const auto exposure = node.find("exposure")) {
        image.exposure = static_cast<float>(exposure->number({.low = 1e-6, .high = 1e6}));
    }
    return image;
}

Lighting readLighting(const JsonNode& node) {
    node.object();
    Lighting lighting;
    const auto read = [&](Word key, float& weight, const NumberRange& range) {
        if (const auto found = node.find(key)) weight = static_cast<float>(found->number(range));
    };
    read("ambient", lighting.ambient, kShare);
    read("diffuse", lighting.diffuse, kShare);
    read("specular", lighting.specular, kShare);
    read("shininess", lighting.shininess, {.low = 1, .high = 10000});
    return lighting;
}

void readDetail(const JsonNode& node, Scene& scene) {
    node.object();
    const auto pixels = node.find("pixels");
    const auto errorPixels = node.find("error_pixels");
    if (pixels && errorPixels)
        errorPixels->fail("\"pixels\" and \"error_pixels\" exclude each other", "keep one");
    if (pixels) scene.quality.pixels = pixels->number(kPositive);
    if (errorPixels) scene.quality.errorPixels = errorPixels->number(kPositive);
}

void readQuality(const JsonNode& node, Scene& scene) {
    node.object();
    if (const auto frame = node.find("frame_ms")) {
        scene.quality.frameMilliseconds = frame->number(kPositive);
        scene.notes.push_back("quality: frame_ms is not acted on yet; a frame takes the time it needs.");
    }
    if (const auto exact = node.find("exact_order")) scene.quality.exactOrder = exact->boolean();
}

void refuseUnavailable(const JsonNode& root) {
    for (const Word key : {Word("terrain"), Word("ocean"), Word("sky")}) {
        if (const auto node = root.find(key)) {
            node->failUnavailable(inQuotes(key), "remove it: volumes and meshes are what a scene can show");
        }
    }
}

void readContents(const JsonNode& root, const std::filesystem::path& baseFolder, Scene& scene) {
    const auto meshes = root.find("meshes");
    for (std::size_t i = 0; meshes && i < meshes->size(); ++i)
        scene.meshes.push_back(readMeshObject(meshes->item(i), baseFolder));
    const auto volumes = scene.meshes.empty() ? std::optional(root.require("volumes")) : root.find("volumes");
    if (!volumes) return;
    if (volumes->size() == 0 && scene.meshes.empty())
        volumes->fail("expected at least one volume, found none");
    for (std::size_t i = 0; i < volumes->size(); ++i)
        scene.volumes.push_back(readVolume(volumes->item(i), baseFolder, asksForShadedVolume(root)));
}

Scene readScene(const JsonNode& root, const std::filesystem::path& baseFolder) {
    root.object();
    root.require("version").integer(1, 1);
    if (const auto schema = root.find("$schema")) schema->text();
    refuseUnavailable(root);
    Scene scene;
    readContents(root, baseFolder, scene);
    if (const auto time = root.find("time")) scene.time = readTimeline(*time);
    if (const auto camera = root.find("camera")) scene.camera = readCamera(*camera);
    if (const auto image = root.find("image")) scene.image = readImage(*image);
    if (const auto lighting = root.find("lighting")) scene.lighting = readLighting(*lighting);
    if (const auto method = root.find("transparency")) scene.transparency = readTransparency(*method);
    if (const auto clip = root.find("clip")) readClip(*clip, scene.clip, scene.solids);
    if (const auto detail = root.find("detail")) readDetail(*detail, scene);
    if (const auto quality = root.find("quality")) readQuality(*quality, scene);
    if (const auto style = root.find("style")) readStyle(*style, scene);
    checkClip(root, scene);
    return scene;
}

}  // namespace

Scene parseScene(std::string_view text, const std::filesystem::path& baseFolder,
                 const std::string& nameForErrors) {
    const nlohmann::json document = parseJson(text, nameForErrors);
    return readScene(JsonNode(document, nameForErrors), baseFolder);
}

std::string readSceneText(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    if (!stream)
        throw Error("cannot open the scene file: " + std::string(std::strerror(errno)), file.string());
    std::string text;
    try {
        text.assign(std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>());
    } catch (const std::ios_base::failure&) {
        throw Error("cannot read the scene file: " + std::string(std::strerror(errno)), file.string());
    }
    return text;
}

Scene loadScene(const std::filesystem::path& file) {
    return parseScene(readSceneText(file), file.parent_path(), file.string());
}

}  // namespace isoglass
