#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace isoglass {

/// An edge of the Kuhn lattice inside one cell: from corner `corner` to corner `corner | direction`.
/// Corner c of a cell lies at (c & 1, c >> 1 & 1, c >> 2); direction has the same three bits.
struct CellEdge {
    std::uint8_t corner;
    std::uint8_t direction;
};

inline constexpr int kAxisEdges = 12;
inline constexpr int kCellEdges = 19;
inline constexpr std::uint8_t kBodyEdge = 18;

/// Numbers 0..11 are the axis edges, 12..17 the face diagonals, 18 the body diagonal.
inline constexpr std::array<CellEdge, kCellEdges> kCellEdge = {{
    {0, 1}, {2, 1}, {4, 1}, {6, 1}, {0, 2}, {1, 2}, {4, 2}, {5, 2}, {0, 4}, {1, 4},
    {2, 4}, {3, 4}, {0, 3}, {4, 3}, {0, 5}, {2, 5}, {0, 6}, {1, 6}, {0, 7},
}};

/// The surface inside one cell for one of the 256 patterns of inside corners (bit c = corner c inside).
///
/// The cell is split into six tetrahedra along the diagonal from corner 0 to corner 7, so no pattern is
/// ambiguous. Every crossed face diagonal `d` gives a row (p, d, q, x): it stands for the triangles
/// (p, d, x) and (d, q, x), p and q being the axis crossings beside d in its face and x the body vertex
/// or an axis crossing. Leaving d out gives the one triangle (p, q, x). Triangles are counter-clockwise
/// seen from outside. Vertices are named by the number of their edge.
struct CellCase {
    struct Row {
        std::int8_t diagonal;  ///< crossed face diagonal, or -1 for a plain triangle (p, q, x)
        std::uint8_t p;
        std::uint8_t q;
        std::uint8_t x;
    };

    std::vector<Row> rows;  ///< at most 12
    bool crossesBody = false;
    /// Axis crossing that can stand for the body vertex: no chord from it lies in a face of the cell.
    /// -1 where the body diagonal is not crossed, or where no crossing will do and the body vertex stays.
    std::int8_t apex = -1;
    /// The compact form: triangles on axis crossings, and the body vertex where `apex` is -1.
    std::vector<std::array<std::uint8_t, 3>> compact;

    bool needsBodyVertex() const { return crossesBody && apex < 0; }
};

/// All 256 cases, made once by a program; thread-safe.
const std::array<CellCase, 256>& cellTable();

}  // namespace isoglass
