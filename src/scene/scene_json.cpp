#include "scene/clip_json.h"
#include "scene/color.h"
#include "scene/color_json.h"
#include "scene/opacity_json.h"
#include "scene/placement_json.h"
#include "scene/scene_file.h"
#include "scene/style_json.h"
#include "scene/transparency.h"

#include <glm/vec2.hpp>
#include <nlohmann/json.hpp>

namespace isoglass {

namespace {

using Json = nlohmann::ordered_json;

Json vector(const glm::dvec3& v) {
    return Json::array({v.x, v.y, v.z});
}

Json time(const SceneTime& time) {
    return std::visit([](const auto& value) { return Json(value); }, time);
}

Json surface(const Surface& surface, const std::filesystem::path& baseFolder) {
    return {{"iso", surface.iso},
            {"inside", surface.inside == Inside::above ? "above" : "below"},
            {"color", surfaceColorJson(surface, baseFolder)},
            {"opacity", opacityJson(surface)},
            {"secondary", surface.secondary}};
}

Json mesh(const MeshObject& mesh, const std::filesystem::path& baseFolder) {
    return {{"name", mesh.name},
            {"file", relativeSeriesPath(mesh.file, baseFolder)},
            {"place", placementJson(mesh.place)},
            {"color", hexFromLinear(mesh.color)},
            {"opacity", shortestDouble(mesh.opacity)},
            {"secondary", mesh.secondary}};
}

Json volume(const Volume& volume, const std::filesystem::path& baseFolder) {
    Json json{{"name", volume.name}, {"series", relativeSeriesPath(volume.series, baseFolder)}};
    if (!volume.moreSeries.empty()) {
        json["series"] = Json::array({json["series"]});
        for (const auto& file : volume.moreSeries)
            json["series"].push_back(relativeSeriesPath(file, baseFolder));
    }
    if (!volume.grid.empty()) json["grid"] = volume.grid;
    json["place"] = placementJson(volume.place);
    json["time"] = {{"offset", volume.time.offset}, {"scale", volume.time.scale}};
    json["boundary"] = volume.closed ? "closed" : "open";
    json["clip"] = clipJson(volume.clip, volume.solids);
    json["surfaces"] = Json::array();
    for (const Surface& each : volume.surfaces) json["surfaces"].push_back(surface(each, baseFolder));
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
    json["meshes"] = Json::array();
    for (const MeshObject& each : scene.meshes) json["meshes"].push_back(mesh(each, baseFolder));
    json["time"] = {{"from", time(scene.time.from)},
                    {"to", time(scene.time.to)},
                    {"duration", scene.time.duration},
                    {"fps", scene.time.fps}};
    json["camera"] = camera(scene.camera);
    json["image"] = {
        {"size", Json::array({scene.image.size.x, scene.image.size.y})},
        {"background", textFromBackdrop({scene.image.background, scene.image.backgroundOpacity})},
        {"samples", scene.image.samples},
        {"legend", scene.image.legend},
        {"exposure", shortestDouble(scene.image.exposure)}};
    json["lighting"] = {{"ambient", shortestDouble(scene.lighting.ambient)},
                        {"diffuse", shortestDouble(scene.lighting.diffuse)},
                        {"specular", shortestDouble(scene.lighting.specular)},
                        {"shininess", shortestDouble(scene.lighting.shininess)}};
    json["transparency"] = transparencyJson(scene.transparency);
    json["clip"] = clipJson(scene.clip, scene.solids);
    const Quality& quality = scene.quality;
    if (quality.pixels) json["detail"]["pixels"] = *quality.pixels;
    if (quality.errorPixels) json["detail"]["error_pixels"] = *quality.errorPixels;
    if (quality.frameMilliseconds) json["quality"]["frame_ms"] = *quality.frameMilliseconds;
    json["quality"]["exact_order"] = quality.exactOrder;
    if (scene.layers) json["style"] = styleJson(*scene.layers);
    if (scene.illustrative) json["style"] = styleJson(*scene.illustrative);
    if (scene.shaded) json["style"] = styleJson(*scene.shaded);
    return json.dump(2) + "\n";
}

}  // namespace isoglass
