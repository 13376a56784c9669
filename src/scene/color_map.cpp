#include "scene/color_map.h"

#include "scene/color.h"

#include <algorithm>
#include <string>

namespace isoglass {

std::vector<std::string_view> colorMapNames() {
    std::vector<std::string_view> names;
    for (const ColorMapTable& table : kColorMapTables) names.push_back(table.name);
    return names;
}

std::array<LinearColor, kColorMapSize> colorMap(std::size_t map) {
    std::array<LinearColor, kColorMapSize> colors;
    const std::string_view digits = kColorMapTables.at(map).digits;
    for (std::size_t i = 0; i < kColorMapSize; ++i)
        colors[i] = linearFromHex("#" + std::string(digits.substr(6 * i, 6))).value();
    return colors;
}

LinearColor colorAt(const std::array<LinearColor, kColorMapSize>& map, double position) {
    const double place = std::clamp(position, 0.0, 1.0) * (kColorMapSize - 1);
    const auto low = std::min(static_cast<std::size_t>(place), kColorMapSize - 2);
    const auto part = static_cast<float>(place - static_cast<double>(low));
    return map[low] + part * (map[low + 1] - map[low]);
}

}  // namespace isoglass
