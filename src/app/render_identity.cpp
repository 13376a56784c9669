#include "app/render_identity.h"

#include "gl/headless_context.h"
#include "scene/scene_file.h"
#include "volume/series_json.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <fstream>
#include <iterator>

namespace isoglass {

namespace {

std::string bytesOf(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

/// Adds every file that a text of the scene names, whatever it is there for; series are known already.
void addNamedFiles(const nlohmann::json& value, const std::filesystem::path& baseFolder, Digest& digest) {
    if (value.is_structured()) {
        for (const auto& item : value) addNamedFiles(item, baseFolder, digest);
    } else if (value.is_string()) {
        const std::filesystem::path path = baseFolder / value.get_ref<const std::string&>();
        std::error_code ignored;
        if (path.extension() != ".vdb" && std::filesystem::is_regular_file(path, ignored))
            digest.add(bytesOf(path));
    }
}

}  // namespace

void Digest::add(std::string_view text) {
    constexpr std::uint64_t kPrime = 1099511628211u;
    for (const char letter : text) value_ = (value_ ^ static_cast<unsigned char>(letter)) * kPrime;
    for (std::size_t length = text.size(), i = 0; i < 8; ++i, length >>= 8)
        value_ = (value_ ^ (length & 0xff)) * kPrime;
}

std::uint64_t renderIdentity(const Scene& scene, const SceneExtractor& extractor) {
    Digest digest;
    // The program's bytes, because its version does not change with every build.
    digest.add(bytesOf("/proc/self/exe"));
    // Rooted paths: the folder that the program is called from does not count.
    const std::filesystem::path root("/");
    const std::string text = toJson(scene, root);
    digest.add(text);
    addNamedFiles(nlohmann::json::parse(text), root, digest);
    for (const auto& file : extractor.files()) digest.add(toJson(file->description()));
    gl::HeadlessContext context;
    digest.add(context.context().rendererName());
    digest.add(context.context().version());
    return digest.value();
}

}  // namespace isoglass
