#pragma once

#include "scene/scene.h"

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

namespace isoglass {

/// A perceptually uniform colour map as it is stored.
struct ColorMapTable {
    std::string_view name;    ///< as scenes write it
    std::string_view digits;  ///< 256 sRGB colours, six hexadecimal digits each
};

inline constexpr std::size_t kColorMapCount = 7;
extern const std::array<ColorMapTable, kColorMapCount> kColorMapTables;

inline constexpr std::size_t kColorMapSize = 256;

/// Names of all maps.
std::vector<std::string_view> colorMapNames();

/// The colours of a map, linear light, from the low end of its range to the high end.
std::array<LinearColor, kColorMapSize> colorMap(std::size_t map);

/// The colour at `position`, 0 to 1 (clamped), linear between the map's colours in linear light.
LinearColor colorAt(const std::array<LinearColor, kColorMapSize>& map, double position);

}  // namespace isoglass
