#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace isoglass {

/// A rectangle of pixels, row 0 on top, without padding.
template <typename Pixel>
struct Raster {
    glm::ivec2 size{0};
    std::vector<Pixel> pixels;  ///< size.x * size.y

    const Pixel& at(int x, int y) const { return pixels[index(x, y)]; }
    Pixel& at(int x, int y) { return pixels[index(x, y)]; }

    friend bool operator==(const Raster&, const Raster&) = default;

  private:
    std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(size.x) + static_cast<std::size_t>(x);
    }
};

/// sRGB-encoded color with straight alpha.
struct Rgba8 {
    std::uint8_t r, g, b, a;

    friend bool operator==(const Rgba8&, const Rgba8&) = default;
};

using Image = Raster<Rgba8>;
using LinearImage = Raster<glm::vec3>;  ///< linear light times alpha, not clamped
using DepthImage = Raster<float>;       ///< reversed: near/distance along the view axis, 0 is nothing

}  // namespace isoglass
