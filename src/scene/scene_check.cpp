#include "scene/scene_check.h"

#include "scene/json_document.h"
#include "scene/scene_file.h"

#include <array>
#include <utility>

namespace isoglass {

namespace {

using nlohmann::json;
using Pointer = json::json_pointer;

/// A scene with more errors than this is no scene.
constexpr std::size_t kMostErrors = 100;

/// Harmless values of required keys, by the pointer with `*` for the place in an array.
constexpr std::array<std::pair<std::string_view, std::string_view>, 12> kHarmless = {{
    {"/version", "1"},
    {"/volumes", R"([{"series": "replaced.vdb", "surfaces": [{"iso": 0}]}])"},
    {"/volumes/*", R"({"series": "replaced.vdb", "surfaces": [{"iso": 0}]})"},
    {"/volumes/*/series", R"("replaced.vdb")"},
    {"/volumes/*/surfaces", R"([{"iso": 0}])"},
    {"/volumes/*/surfaces/*", R"({"iso": 0})"},
    {"/volumes/*/surfaces/*/iso", "0"},
    {"/volumes/*/surfaces/*/opacity", "1"},
    {"/meshes/*", R"({"file": "replaced.ply"})"},
    {"/meshes/*/file", R"("replaced.ply")"},
    // Without its style a volume may miss its surfaces.
    {"/style/colors", R"([[0, "#000000"]])"},
    {"/style/opacities", "[[0, 0]]"},
}};

bool isIndex(const std::string& token) {
    return !token.empty() && token.find_first_not_of("0123456789") == std::string::npos;
}

std::string kindOf(Pointer pointer) {
    std::vector<std::string> tokens;
    for (; !pointer.empty(); pointer.pop_back()) tokens.push_back(pointer.back());
    std::string kind;
    for (auto token = tokens.rbegin(); token != tokens.rend(); ++token)
        kind += isIndex(*token) ? "/*" : "/" + *token;
    return kind;
}

std::optional<json> harmlessValue(const Pointer& pointer) {
    const std::string kind = kindOf(pointer);
    for (const auto& [place, value] : kHarmless) {
        if (place == kind) return json::parse(value);
    }
    return std::nullopt;
}

/// Puts a harmless value at the place, or takes the key out; false where neither changes anything.
bool mend(json& document, const Pointer& place) {
    const auto harmless = harmlessValue(place);
    if (document.contains(place)) {
        if (harmless && document[place] == *harmless) return false;
        json& parent = document[place.parent_pointer()];
        if (harmless) {
            document[place] = *harmless;
        } else if (parent.is_object()) {
            parent.erase(place.back());
        } else {
            return false;  // elements of an array hold their places
        }
        return true;
    }
    const Pointer parent = place.parent_pointer();
    if (!harmless || !document.contains(parent) || !document[parent].is_object()) return false;
    document[place] = *harmless;
    return true;
}

/// The JSON pointer in "NAME, POINTER".
std::optional<std::string> pointerIn(const std::string& where, const std::string& name) {
    if (where == name) return "";
    if (!where.starts_with(name + ", /")) return std::nullopt;
    return where.substr(name.size() + 2);
}

/// True where one of the two places holds the other.
bool related(const std::string& a, const std::string& b) {
    const std::string& shorter = a.size() < b.size() ? a : b;
    const std::string& longer = a.size() < b.size() ? b : a;
    return longer.starts_with(shorter) && (longer.size() == shorter.size() || longer[shorter.size()] == '/');
}

}  // namespace

bool SceneProblems::touches(const std::string& pointer) const {
    for (const std::string& place : replaced) {
        if (related(place, pointer)) return true;
    }
    return false;
}

SceneProblems checkScene(std::string_view text, const std::filesystem::path& baseFolder,
                         const std::string& name) {
    SceneProblems problems;
    json document;
    try {
        document = parseJson(text, name);
    } catch (const Error& error) {
        problems.errors.push_back(error);
        return problems;
    }
    while (problems.errors.size() < kMostErrors) {
        try {
            problems.rest = parseScene(document.dump(), baseFolder, name);
            return problems;
        } catch (const Error& error) {
            const auto pointer = pointerIn(error.where(), name);
            // An error where something was mended comes of the mending.
            if (!pointer || !problems.touches(*pointer)) problems.errors.push_back(error);
            if (!pointer || pointer->empty()) return problems;
            Pointer place(*pointer);
            while (!place.empty() && !mend(document, place)) place.pop_back();
            if (place.empty()) return problems;
            problems.replaced.insert(place.to_string());
        }
    }
    return problems;
}

}  // namespace isoglass
