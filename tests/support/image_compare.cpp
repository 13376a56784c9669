#include "support/image_compare.h"

#include "render/png_file.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>

namespace isoglass::test {
namespace {

double pixelDifference(const glm::vec3& a, const glm::vec3& b) {
    double worst = 0;
    for (int i = 0; i < 3; ++i) {
        if (!std::isfinite(a[i]) || !std::isfinite(b[i])) return std::numeric_limits<double>::infinity();
        worst = std::max(worst, std::abs(double(a[i]) - double(b[i])));
    }
    return worst;
}

std::uint8_t srgbByte(float linear) {
    const float c = std::clamp(linear, 0.0f, 1.0f);
    const float encoded = c <= 0.0031308f ? 12.92f * c : 1.055f * std::pow(c, 1 / 2.4f) - 0.055f;
    return static_cast<std::uint8_t>(std::lround(255 * encoded));
}

Image pictureOf(const LinearImage& image) {
    Image picture{image.size, {}};
    for (const glm::vec3& c : image.pixels) {
        picture.pixels.push_back({srgbByte(c.r), srgbByte(c.g), srgbByte(c.b), 255});
    }
    return picture;
}

}  // namespace

std::string ImageDifference::describe() const {
    std::ostringstream text;
    text << "mean " << mean << ", " << changed << " of " << pixels << " pixels changed ("
         << 100 * changedShare() << " %), largest " << largest;
    if (largestAt.x >= 0) text << " at " << largestAt.x << "," << largestAt.y;
    if (masked > 0) text << ", not counting " << masked << " silhouette pixels";
    return text.str();
}

ImageDifference compareImages(const LinearImage& actual, const LinearImage& expected,
                              const Raster<std::uint8_t>& mask, double threshold) {
    const auto differs = [](glm::ivec2 a, glm::ivec2 b) { return a.x != b.x || a.y != b.y; };
    if (differs(actual.size, expected.size) || (!mask.pixels.empty() && differs(mask.size, expected.size))) {
        throw std::invalid_argument("pictures of different sizes are compared");
    }
    ImageDifference result;
    result.pixels = expected.pixels.size();
    for (int y = 0; y < expected.size.y; ++y) {
        for (int x = 0; x < expected.size.x; ++x) {
            const double difference = pixelDifference(actual.at(x, y), expected.at(x, y));
            result.mean += difference / double(result.pixels);
            result.changed += difference > threshold;
            if (!mask.pixels.empty() && mask.at(x, y) != 0) {
                ++result.masked;
            } else if (difference > result.largest) {
                result.largest = difference;
                result.largestAt = {x, y};
            }
        }
    }
    return result;
}

LinearImage linearOf(const Image& image) {
    LinearImage linear{image.size, {}};
    const auto decode = [](std::uint8_t byte) {
        const float c = byte / 255.0f;
        return c <= 0.04045f ? c / 12.92f : std::pow((c + 0.055f) / 1.055f, 2.4f);
    };
    for (const Rgba8& p : image.pixels) linear.pixels.emplace_back(decode(p.r), decode(p.g), decode(p.b));
    return linear;
}

Image differenceMap(const LinearImage& actual, const LinearImage& expected, const Raster<std::uint8_t>& mask,
                    double threshold) {
    Image map{expected.size, std::vector<Rgba8>(expected.pixels.size())};
    for (std::size_t i = 0; i < map.pixels.size(); ++i) {
        const double share = pixelDifference(actual.pixels[i], expected.pixels[i]) / threshold;
        const auto gray = static_cast<std::uint8_t>(255 * std::clamp(share, 0.0, 1.0));
        const bool masked = !mask.pixels.empty() && mask.pixels[i] != 0;
        map.pixels[i] = {gray, gray, masked ? std::uint8_t{255} : gray, 255};
    }
    return map;
}

std::string differenceBeyond(const ImageLimits& limits, const std::string& name, const LinearImage& actual,
                             const LinearImage& expected, const Raster<std::uint8_t>& mask) {
    const ImageDifference found = compareImages(actual, expected, mask, limits.threshold);
    if (found.mean <= limits.mean && found.changedShare() <= limits.changedShare &&
        found.largest <= limits.largest) {
        return {};
    }
    const std::filesystem::path folder = std::filesystem::temp_directory_path() / "isoglass-test-output";
    std::filesystem::create_directories(folder);
    const auto map = folder / (name + "-difference.png");
    writePng(map, differenceMap(actual, expected, mask, limits.threshold));
    writePng(folder / (name + "-actual.png"), pictureOf(actual));
    writePng(folder / (name + "-expected.png"), pictureOf(expected));
    std::ostringstream text;
    text << name << ": " << found.describe() << "; allowed are mean " << limits.mean << ", changed "
         << 100 * limits.changedShare << " %, largest " << limits.largest << "; see " << map.string();
    return text.str();
}

}  // namespace isoglass::test
