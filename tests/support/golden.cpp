#include "support/golden.h"

#include "render/png_file.h"

#include <cstdlib>
#include <filesystem>

namespace isoglass::test {

std::string differenceFromGolden(const std::string& name, const Image& actual, const ImageLimits& limits) {
    const auto file = std::filesystem::path(ISOGLASS_GOLDEN_FOLDER) / (name + ".png");
    if (std::getenv("ISOGLASS_UPDATE_GOLDEN") != nullptr) {
        writePng(file, actual);
        return file.string() + " was written; look at it";
    }
    if (!std::filesystem::exists(file)) return file.string() + " is missing";
    const Image golden = readPng(file);
    if (golden.size != actual.size) return file.string() + " has another size";
    return differenceBeyond(limits, name, linearOf(actual), linearOf(golden));
}

}  // namespace isoglass::test
