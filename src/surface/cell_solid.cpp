#include "surface/cell_solid.h"

#include "surface/cell_table.h"

namespace isoglass {

namespace {

/// Corners of a face, counter-clockwise seen from outside the cell.
std::array<int, 4> faceCorners(int face) {
    const int axis = face / 2;
    const int u = 1 << (axis + 1) % 3;
    const int v = 1 << (axis + 2) % 3;
    const int low = face % 2 == 0 ? 0 : 1 << axis;
    if (face % 2 == 1) return {low, low | u, low | u | v, low | v};
    return {low, low | v, low | u | v, low | u};
}

std::uint8_t crossing(int a, int b) {
    for (int edge = 0; edge < kAxisEdges; ++edge) {
        if (kCellEdge[edge].corner == (a & b) && kCellEdge[edge].direction == (a ^ b))
            return static_cast<std::uint8_t>(kFirstCrossing + edge);
    }
    return 0;
}

/// Walks around the face: inside corners and crossings in order.
std::vector<std::uint8_t> walk(int pattern, const std::array<int, 4>& corners) {
    std::vector<std::uint8_t> points;
    for (int k = 0; k < 4; ++k) {
        const int here = corners[k];
        const int next = corners[(k + 1) % 4];
        if (pattern >> here & 1) points.push_back(static_cast<std::uint8_t>(here));
        if ((pattern >> here & 1) != (pattern >> next & 1)) points.push_back(crossing(here, next));
    }
    return points;
}

/// Two inside corners on a diagonal are one piece where the diagonal is an edge of the Kuhn lattice, whose
/// lower end is the face's lowest corner; else two.
bool isTwoPieces(int pattern, const std::array<int, 4>& corners) {
    const auto inside = [&](int k) { return pattern >> corners[k] & 1; };
    return !inside(0) && inside(1) && !inside(2) && inside(3);
}

void addFace(int pattern, int face, CellSolid& solid) {
    const std::array<int, 4> corners = faceCorners(face);
    if (!isTwoPieces(pattern, corners)) {
        std::vector<std::uint8_t> points = walk(pattern, corners);
        if (!points.empty()) solid.polygons.push_back({static_cast<std::int8_t>(face), std::move(points)});
        return;
    }
    for (const int k : {1, 3}) {
        const int corner = corners[k];
        solid.polygons.push_back({static_cast<std::int8_t>(face),
                                  {crossing(corners[k - 1], corner), static_cast<std::uint8_t>(corner),
                                   crossing(corner, corners[(k + 1) % 4])}});
    }
}

CellSolid makeSolid(int pattern) {
    CellSolid solid;
    for (const auto& triangle : cellTable()[pattern].compact) {
        std::vector<std::uint8_t> points;
        for (const std::uint8_t edge : triangle)
            points.push_back(edge == kBodyEdge ? kBodyCrossing : kFirstCrossing + edge);
        solid.polygons.push_back({-1, std::move(points)});
    }
    for (int face = 0; face < 6; ++face) addFace(pattern, face, solid);
    return solid;
}

}  // namespace

const std::array<CellSolid, 256>& cellSolids() {
    static const std::array<CellSolid, 256> solids = [] {
        std::array<CellSolid, 256> made;
        for (int pattern = 0; pattern < 256; ++pattern) made[pattern] = makeSolid(pattern);
        return made;
    }();
    return solids;
}

}  // namespace isoglass
