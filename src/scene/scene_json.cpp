#include "scene/color.h"
#include "scene/scene_file.h"
#include "scene/transparency.h"

#include <glm/vec2.hpp>
#include <nlohmann/json.hpp>

#include <array>
#include <charconv>

namespace isoglass {

namespace {

using Json = nlohmann::ordered_json;

/// The double with the fewest digits that is `value` when rounded to single precision: 0.3, not
/// 0.30000001192092896.
double shortest(float value) {
    std::array<char, 32> text;
    const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
    double result = 0;
    std::from_chars(text.data(), end, result);
    return result;
}

Json vector(const glm::dvec3& v) {
    return Json::array({v.x, v.y, v.z});
}

Json time(const SceneTime& time) {
    return std::visit([](const auto& value) { return Json(value); }, time);
}

std::string seriesPath(const std::filesystem::path& series, const std::filesystem::path& baseFolder) {
    if (baseFolder.empty()) return series.string();
    return std::filesystem::absolute(series)
        .lexically_normal()
        .lexically_relative(std::filesystem::absolute(baseFolder).lexically_normal())
        .string();
}

Json surface(const Surface& surface) {
    return {{"iso", surface.iso},
            {"inside", surface.inside == Inside::above ? "above" : "below"},
            {"color", hexFromLinear(surface.color)},
            {"opacity", shortest(surface.opacity)}};
}

Json volume(const Volume& volume, const std::filesystem::path& baseFolder) {
    Json json{{"name", volume.name}, {"series", seriesPath(volume.series, baseFolder)}};
    if (!volume.moreSeries.empty()) {
        json["series"] = Json::array({json["series"]});
        for (const auto& file : volume.moreSeries) json["series"].push_back(seriesPath(file, baseFolder));
    }
    if (!volume.grid.empty()) json["grid"] = volume.grid;
    const glm::dvec4& rotate = volume.place.rotate;
    json["place"] = {{"translate", vector(volume.place.translate)},
                     {"rotate", Json::array({rotate.x, rotate.y, rotate.z, rotate.w})},
                     {"scale", vector(volume.place.scale)}};
    json["time"] = {{"offset", volume.time.offset}, {"scale", volume.time.scale}};
    json["surfaces"] = Json::array();
    for (const Surface& each : volume.surfaces) json["surfaces"].push_back(surface(each));
    return json;
}

Json camera(const Camera& camera) {
    Json json{{"eye", vector(camera.pose.eye)},
              {"target", vector(camera.pose.target)},
              {"up", vector(camera.up)},
              {"fov", camera.fovDegrees}};
    json["path"] = Json::array();
    for (const CameraKey& key : camera.path) {
        json["path"].push_back(
            {{"at", key.at}, {"eye", vector(key.pose.eye)}, {"target", vector(key.pose.target)}});
    }
    return json;
}

Json transparencyJson(const Transparency& transparency) {
    Json json{{"method", transparencyMethodName(transparency.method)}};
    if (transparency.method == TransparencyMethod::peel) json["layers"] = transparency.layers;
    json["reproducible"] = transparency.reproducible;
    return json;
}

}  // namespace

std::string toJson(const Scene& scene, const std::filesystem::path& baseFolder) {
    Json json = Json::object();
    json["version"] = 1;
    json["volumes"] = Json::array();
    for (const Volume& each : scene.volumes) json["volumes"].push_back(volume(each, baseFolder));
    json["time"] = {{"from", time(scene.time.from)},
                    {"to", time(scene.time.to)},
                    {"duration", scene.time.duration},
                    {"fps", scene.time.fps}};
    json["camera"] = camera(scene.camera);
    json["image"] = {
        {"size", Json::array({scene.image.size.x, scene.image.size.y})},
        {"background", textFromBackdrop({scene.image.background, scene.image.backgroundOpacity})},
        {"samples", scene.image.samples},
        {"exposure", shortest(scene.image.exposure)}};
    json["lighting"] = {{"ambient", shortest(scene.lighting.ambient)},
                        {"diffuse", shortest(scene.lighting.diffuse)},
                        {"specular", shortest(scene.lighting.specular)},
                        {"shininess", shortest(scene.lighting.shininess)}};
    json["transparency"] = transparencyJson(scene.transparency);
    const Quality& quality = scene.quality;
    if (quality.pixels) json["detail"]["pixels"] = *quality.pixels;
    if (quality.errorPixels) json["detail"]["error_pixels"] = *quality.errorPixels;
    if (quality.frameMilliseconds) json["quality"]["frame_ms"] = *quality.frameMilliseconds;
    json["quality"]["exact_order"] = quality.exactOrder;
    return json.dump(2) + "\n";
}

}  // namespace isoglass
