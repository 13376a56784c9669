#pragma once

#include "render/image.h"

#include <glm/vec2.hpp>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>

namespace isoglass::test {

/// How two pictures of one size differ, in linear light; a pixel's difference is that of its worst
/// component.
struct ImageDifference {
    double mean = 0;           ///< over all pixels
    double largest = 0;        ///< over the pixels that the mask leaves
    glm::ivec2 largestAt{-1};  ///< pixel of `largest`
    std::size_t changed = 0;   ///< pixels, masked ones too, that differ by more than the threshold
    std::size_t masked = 0;
    std::size_t pixels = 0;

    double changedShare() const { return pixels > 0 ? double(changed) / double(pixels) : 0; }
    /// For messages: the numbers, and where the largest one is.
    std::string describe() const;
};

/// What a comparison may find. A silhouette sample may flip for any small change, so the mean and the
/// share of changed pixels are bounded over the whole picture, the maximum only where the mask is 0.
struct ImageLimits {
    double threshold = 1e-3;  ///< a pixel that differs by more has changed
    double mean = 0;
    double changedShare = 0;
    double largest = 0;  ///< away from masked pixels
};

/// Compares `actual` with `expected`; `mask` (1 = silhouette) may be empty. A component that is not
/// finite in one of them counts as an infinite difference. Throws std::invalid_argument where the sizes
/// differ.
ImageDifference compareImages(const LinearImage& actual, const LinearImage& expected,
                              const Raster<std::uint8_t>& mask = {}, double threshold = 1e-3);

/// The linear light of an 8-bit picture, by the sRGB curve; alpha is not looked at.
LinearImage linearOf(const Image& image);

/// The difference as a picture: black where equal, white at `threshold` and above, masked pixels tinted
/// blue.
Image differenceMap(const LinearImage& actual, const LinearImage& expected, const Raster<std::uint8_t>& mask,
                    double threshold);

/// Empty where the pictures agree within the limits; else what differs, by how much and where. Then the
/// two pictures and the map of their difference are written as PNG to a folder that the text names.
std::string differenceBeyond(const ImageLimits& limits, const std::string& name, const LinearImage& actual,
                             const LinearImage& expected, const Raster<std::uint8_t>& mask = {});

}  // namespace isoglass::test
