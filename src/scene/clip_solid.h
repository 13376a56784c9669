#pragma once

#include <cstddef>

namespace isoglass {

/// A solid in its own coordinates, about the origin.
enum class SolidShape {
    box,       ///< [-1,1]^3
    sphere,    ///< of radius 1
    cylinder,  ///< of radius 1 about the z axis, from z = -1 to 1
};

/// What a clip object leaves of a volume (D. Weiskopf, K. Engel and T. Ertl, "Interactive Clipping Techniques
/// for Texture-Based Volume Visualization and Volume Shading", 2003, section 3).
enum class Keep {
    inside,   ///< volume probing
    outside,  ///< volume cutting
};

/// That clip one volume which rays go through.
inline constexpr std::size_t kMostSolids = 8;
inline constexpr std::size_t kMostVolumePlanes = 16;  ///< likewise

}  // namespace isoglass
