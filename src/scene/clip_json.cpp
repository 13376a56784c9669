#include "scene/clip_json.h"

#include "scene/placement_json.h"

#include <glm/geometric.hpp>

#include <array>
#include <cmath>
#include <string>

namespace isoglass {

namespace {

using Word = std::string_view;

/// In the orders of SolidShape and Keep.
constexpr std::array kShapes{Word("box"), Word("sphere"), Word("cylinder")};
constexpr std::array kKeeps{Word("inside"), Word("outside")};

template <std::size_t n>
void refuse(const JsonNode& node, const std::array<Word, n>& keys, const char* what) {
    for (const Word key : keys) {
        if (const auto found = node.find(key))
            found->fail("\"" + std::string(key) + "\" does not belong to " + what, "remove it");
    }
}

ClipPlane readPlane(const JsonNode& node) {
    refuse(node, std::array{Word("keep"), Word("place")}, "a plane");
    ClipPlane clip;
    if (const auto cap = node.find("cap")) clip.cap = cap->boolean();
    const JsonNode plane = node.require("plane");
    plane.numbers(4, [&](std::size_t i, double value) { clip.plane[static_cast<int>(i)] = value; });
    const double length = glm::length(glm::dvec3(clip.plane));
    if (!(length > 0) || !std::isfinite(length)) {
        plane.fail("expected a normal that is not zero",
                   "[a, b, c, d] keeps what has a x + b y + c z + d >= 0");
    }
    return clip;
}

ClipSolid readSolid(const JsonNode& node) {
    refuse(node, std::array{Word("plane"), Word("cap")}, "a solid");
    ClipSolid clip;
    clip.shape = static_cast<SolidShape>(node.require("solid").choice(kShapes));
    if (const auto keep = node.find("keep")) clip.keep = static_cast<Keep>(keep->choice(kKeeps));
    if (const auto place = node.find("place")) clip.place = readPlacement(*place);
    return clip;
}

/// The one whose samples rays go through; null where there is none.
const Volume* sampled(const Scene& scene) {
    if (scene.volumes.empty() || !(scene.layers || scene.shaded)) return nullptr;
    const std::string& name = scene.layers ? scene.layers->volume : scene.shaded->volume;
    for (const Volume& volume : scene.volumes) {
        if (name.empty() || volume.name == name) return &volume;
    }
    return nullptr;
}

/// The first object of a list that has `key`.
JsonNode firstWith(const char* key, const JsonNode& list) {
    std::size_t i = 0;
    while (!list.item(i).find(key)) ++i;
    return list.item(i);
}

/// The list that holds what clips `volume`: its own, or else that of the scene.
JsonNode listOf(const JsonNode& root, const Scene& scene, const Volume& volume, bool own) {
    if (!own) return root.require("clip");
    const auto i = static_cast<std::size_t>(&volume - scene.volumes.data());
    return root.require("volumes").item(i).require("clip");
}

void checkSolids(const JsonNode& root, const Scene& scene, const Volume& volume) {
    const std::size_t count = scene.solids.size() + volume.solids.size();
    if (count == 0) return;
    const JsonNode first = firstWith("solid", listOf(root, scene, volume, !volume.solids.empty()));
    const std::size_t byRays = scene.layers && &volume == sampled(scene) ? 1 : 0;
    if (volume.surfaces.size() > byRays) {
        first.failUnavailable("clipping surfaces by a solid",
                              "use planes, or show the volume by the style \"volume\" without surfaces or by "
                              "the style \"layers\" with one");
    }
    if (count > kMostSolids) {
        first.fail(std::to_string(count) + " solids clip one volume",
                   "use at most " + std::to_string(kMostSolids));
    }
}

void checkPlanes(const JsonNode& root, const Scene& scene, const Volume& volume) {
    const std::size_t count = scene.clip.size() + volume.clip.size();
    if (&volume != sampled(scene) || count <= kMostVolumePlanes) return;
    firstWith("plane", listOf(root, scene, volume, !volume.clip.empty()))
        .fail(std::to_string(count) + " planes clip a volume that rays go through",
              "use at most " + std::to_string(kMostVolumePlanes));
}

}  // namespace

void readClip(const JsonNode& list, std::vector<ClipPlane>& planes, std::vector<ClipSolid>& solids) {
    for (std::size_t i = 0; i < list.size(); ++i) {
        const JsonNode node = list.item(i);
        node.object();
        for (const char* key : {"mesh", "method"}) {
            if (const auto found = node.find(key))
                found->failUnavailable("clipping by a mesh", "use a plane or a solid");
        }
        if (node.find("solid")) {
            solids.push_back(readSolid(node));
        } else {
            planes.push_back(readPlane(node));
        }
    }
}

void checkClip(const JsonNode& root, const Scene& scene) {
    for (const Volume& volume : scene.volumes) {
        checkSolids(root, scene, volume);
        checkPlanes(root, scene, volume);
    }
}

nlohmann::ordered_json clipJson(const std::vector<ClipPlane>& planes, const std::vector<ClipSolid>& solids) {
    auto json = nlohmann::ordered_json::array();
    for (const ClipPlane& each : planes) {
        const glm::dvec4& p = each.plane;
        json.push_back({{"plane", nlohmann::ordered_json::array({p.x, p.y, p.z, p.w})}, {"cap", each.cap}});
    }
    for (const ClipSolid& each : solids) {
        json.push_back({{"solid", kShapes[static_cast<std::size_t>(each.shape)]},
                        {"keep", kKeeps[static_cast<std::size_t>(each.keep)]},
                        {"place", placementJson(each.place)}});
    }
    return json;
}

}  // namespace isoglass
