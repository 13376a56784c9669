#pragma once

#include <cstddef>
#include <filesystem>

namespace isoglass {

/// Colour of a surface by a value at each of its points, through a colour map.
struct FieldColor {
    /// Where the value comes from: another series at the same place and time; the volume's own field, which
    /// is the iso-value on the surface and varies on its caps; the surface's mean curvature; the level of
    /// detail of its cells, to look at the mesh.
    enum class By { series, value, curvature, level };

    By by = By::value;
    std::filesystem::path series{};  ///< only for `series`; played by the volume's clock
    std::size_t map = 0;             ///< of `kColorMapTables`
    double low = 0;                  ///< value at the map's low end
    double high = 1;                 ///< at its high end; not `low`

    friend bool operator==(const FieldColor&, const FieldColor&) = default;
};

}  // namespace isoglass
