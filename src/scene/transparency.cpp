#include "scene/transparency.h"

#include <algorithm>
#include <array>

namespace isoglass {
namespace {

constexpr std::array<std::string_view, 6> kNames{"auto", "2-pass", "3-pass", "4-pass", "peel", "exact"};

}  // namespace

std::span<const std::string_view> transparencyMethodNames() {
    return kNames;
}

std::string_view transparencyMethodName(TransparencyMethod method) {
    return kNames[static_cast<std::size_t>(method)];
}

TransparencyMethod transparencyMethodNamed(std::string_view name) {
    return static_cast<TransparencyMethod>(std::ranges::find(kNames, name) - kNames.begin());
}

Transparency readTransparency(const JsonNode& node) {
    node.object();
    Transparency transparency;
    const auto method = node.find("method");
    if (method) transparency.method = static_cast<TransparencyMethod>(method->choice(kNames));
    if (const auto layers = node.find("layers")) {
        if (transparency.method != TransparencyMethod::peel) {
            layers->fail("\"layers\" belongs to the method \"peel\"", "choose that method, or remove it");
        }
        transparency.layers = layers->integer(1, kMostLayers);
    }
    if (const auto reproducible = node.find("reproducible")) {
        transparency.reproducible = reproducible->boolean();
        if (transparency.reproducible && transparency.method == TransparencyMethod::twoPass) {
            reproducible->fail("the method \"2-pass\" depends on the order of the surfaces",
                               "choose another method, or remove \"reproducible\"");
        }
    }
    return transparency;
}

}  // namespace isoglass
