#include "scene/scene_format.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>
#include <stdexcept>
#include <vector>

namespace isoglass {

namespace {

using Key = std::string_view;

constexpr std::array kScene{Key("$schema"),      Key("version"), Key("volumes"), Key("meshes"),
                            Key("time"),         Key("camera"),  Key("image"),   Key("lighting"),
                            Key("transparency"), Key("detail"),  Key("quality"), Key("clip"),
                            Key("terrain"),      Key("ocean"),   Key("sky"),     Key("style")};
constexpr std::array kVolume{Key("name"), Key("series"),   Key("grid"), Key("place"),
                             Key("time"), Key("boundary"), Key("clip"), Key("surfaces")};
constexpr std::array kClip{Key("plane"), Key("cap"),  Key("solid"), Key("place"),
                           Key("keep"),  Key("mesh"), Key("method")};
constexpr std::array kPlace{Key("translate"), Key("rotate"), Key("scale")};
constexpr std::array kClock{Key("offset"), Key("scale")};
constexpr std::array kSurface{Key("iso"), Key("inside"), Key("color"), Key("opacity"), Key("secondary")};
constexpr std::array kMesh{Key("name"),  Key("file"),    Key("place"),
                           Key("color"), Key("opacity"), Key("secondary")};
constexpr std::array kColor{Key("by"), Key("series"), Key("map"), Key("range")};
constexpr std::array kOpacity{Key("model"),     Key("opacity"),       Key("extinction"), Key("thickness"),
                              Key("iso_width"), Key("max_thickness"), Key("power")};
constexpr std::array kTime{Key("from"), Key("to"), Key("duration"), Key("fps")};
constexpr std::array kCamera{Key("eye"), Key("target"), Key("up"), Key("fov"), Key("path")};
constexpr std::array kCameraKey{Key("at"), Key("eye"), Key("target")};
constexpr std::array kImage{Key("size"), Key("background"), Key("samples"), Key("legend"), Key("exposure")};
constexpr std::array kLighting{Key("ambient"), Key("diffuse"), Key("specular"), Key("shininess")};
constexpr std::array kTransparency{Key("method"), Key("layers"), Key("reproducible")};
constexpr std::array kDetail{Key("pixels"), Key("error_pixels")};
constexpr std::array kQuality{Key("frame_ms"), Key("exact_order")};

/// Of all kinds of styles.
constexpr std::array kStyle{Key("kind"),
                            Key("volume"),
                            Key("show"),
                            Key("count"),
                            Key("first"),
                            Key("colors"),
                            Key("opacities"),
                            Key("step"),
                            Key("silhouette"),
                            Key("alpha"),
                            Key("beta"),
                            Key("depth_threshold"),
                            Key("normal_threshold"),
                            Key("hatch_angle"),
                            Key("hatch_size"),
                            Key("hatch_cross"),
                            Key("light"),
                            Key("paper"),
                            Key("front"),
                            Key("back"),
                            Key("unit"),
                            Key("lit"),
                            Key("cut")};
constexpr std::array kCutLight{Key("thickness"), Key("weight")};

constexpr std::array kFormat{
    FormatObject{"", kScene},
    FormatObject{"/volumes/*", kVolume},
    FormatObject{"/volumes/*/place", kPlace},
    FormatObject{"/volumes/*/time", kClock},
    FormatObject{"/volumes/*/clip/*", kClip},
    FormatObject{"/volumes/*/clip/*/place", kPlace},
    FormatObject{"/volumes/*/surfaces/*", kSurface},
    FormatObject{"/volumes/*/surfaces/*/color", kColor},
    FormatObject{"/volumes/*/surfaces/*/opacity", kOpacity},
    FormatObject{"/meshes/*", kMesh},
    FormatObject{"/meshes/*/place", kPlace},
    FormatObject{"/time", kTime},
    FormatObject{"/camera", kCamera},
    FormatObject{"/camera/path/*", kCameraKey},
    FormatObject{"/image", kImage},
    FormatObject{"/lighting", kLighting},
    FormatObject{"/transparency", kTransparency},
    FormatObject{"/detail", kDetail},
    FormatObject{"/quality", kQuality},
    FormatObject{"/clip/*", kClip},
    FormatObject{"/clip/*/place", kPlace},
    FormatObject{"/style", kStyle},
    FormatObject{"/style/cut", kCutLight},
};

std::size_t editDistance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 0; i < a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i + 1;
        for (std::size_t j = 0; j < b.size(); ++j) {
            const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
            diagonal = row[j + 1];
            row[j + 1] = std::min({replaced, row[j] + 1, row[j + 1] + 1});
        }
    }
    return row.back();
}

}  // namespace

std::span<const FormatObject> sceneFormat() {
    return kFormat;
}

std::span<const std::string_view> sceneKeys(std::string_view pointer) {
    const auto object = std::ranges::find(kFormat, pointer, &FormatObject::pointer);
    if (object == kFormat.end()) throw std::logic_error("no such object: " + std::string(pointer));
    return object->keys;
}

std::string_view closestWord(std::string_view word, std::span<const std::string_view> known) {
    return *std::ranges::min_element(known, {}, [&](Key key) { return editDistance(word, key); });
}

std::string inQuotes(std::string_view word) {
    std::string text(1, '"');
    text += word;
    text += '"';
    return text;
}

std::string listWords(std::span<const std::string_view> words) {
    std::string list;
    for (const std::string_view word : words) {
        if (!list.empty()) list += ", ";
        list += word;
    }
    return list;
}

}  // namespace isoglass
