#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace isoglass {

/// Names of a cell's points: corners 0..7 as in `CellEdge`, then the crossings of the twelve axis edges and
/// of the body diagonal.
inline constexpr std::uint8_t kFirstCrossing = 8;
inline constexpr std::uint8_t kBodyCrossing = 20;
inline constexpr int kSolidPoints = 21;

/// The part of one cell that is inside, for one of the 256 patterns of inside corners, as a closed
/// polyhedron by the names of its points: the compact surface patch and the inside parts of the cell's six
/// faces. Polygons are counter-clockwise seen from outside the polyhedron; every edge belongs to exactly two
/// of them, in opposite directions. The polygons of a face depend on its four corners alone, so those of two
/// touching cells are each other's mirror images.
struct CellSolid {
    struct Polygon {
        std::int8_t face;  ///< 2 * axis, one more at the high end; -1 on the surface
        std::vector<std::uint8_t> points;
    };
    std::vector<Polygon> polygons;
};

/// All 256 cases, made once; thread-safe.
const std::array<CellSolid, 256>& cellSolids();

}  // namespace isoglass
