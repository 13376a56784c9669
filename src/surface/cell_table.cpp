#include "surface/cell_table.h"

#include <algorithm>
#include <map>
#include <stdexcept>

namespace isoglass {

namespace {

/// Directions taken in turn from corner 0 to corner 7: one tetrahedron each.
constexpr std::array<std::array<int, 3>, 6> kPaths = {
    {{1, 2, 4}, {1, 4, 2}, {2, 1, 4}, {2, 4, 1}, {4, 1, 2}, {4, 2, 1}}};

using Vector = std::array<int, 3>;
using Polygon = std::vector<std::uint8_t>;
using Triangle = std::array<std::uint8_t, 3>;

bool isAxisEdge(std::uint8_t edge) {
    return edge < kAxisEdges;
}

std::uint8_t edgeBetween(int cornerA, int cornerB) {
    const int low = std::min(cornerA, cornerB);
    const int direction = cornerA ^ cornerB;
    for (std::uint8_t edge = 0; edge < kCellEdges; ++edge) {
        if (kCellEdge[edge].corner == low && kCellEdge[edge].direction == direction) return edge;
    }
    throw std::logic_error("these corners share no edge of the Kuhn lattice");
}

Vector cornerPosition(int corner) {
    return {corner & 1, corner >> 1 & 1, corner >> 2};
}

/// Middle of an edge in half cells, so that everything stays an integer.
Vector middle(std::uint8_t edge) {
    const Vector low = cornerPosition(kCellEdge[edge].corner);
    const Vector high = cornerPosition(kCellEdge[edge].corner | kCellEdge[edge].direction);
    return {low[0] + high[0], low[1] + high[1], low[2] + high[2]};
}

Vector minus(Vector a, Vector b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
Vector cross(Vector a, Vector b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
int dot(Vector a, Vector b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// Turns the polygon so that its normal points from the inside corners to the outside ones.
void orient(Polygon& polygon, const std::vector<int>& inside, const std::vector<int>& outside) {
    Vector outward{};
    for (int k = 0; k < 3; ++k) {
        for (const int corner : outside)
            outward[k] += cornerPosition(corner)[k] * static_cast<int>(inside.size());
        for (const int corner : inside)
            outward[k] -= cornerPosition(corner)[k] * static_cast<int>(outside.size());
    }
    const Vector origin = middle(polygon[0]);
    const Vector normal = cross(minus(middle(polygon[1]), origin), minus(middle(polygon[2]), origin));
    if (dot(normal, outward) < 0) std::reverse(polygon.begin(), polygon.end());
}

/// Where the surface crosses one tetrahedron: nothing, a triangle or a quad.
Polygon crossTetrahedron(const std::array<int, 3>& path, int insideCorners) {
    const std::array<int, 4> corners = {0, path[0], path[0] | path[1], 7};
    std::vector<int> inside;
    std::vector<int> outside;
    for (const int corner : corners) (insideCorners >> corner & 1 ? inside : outside).push_back(corner);
    if (inside.empty() || outside.empty()) return {};
    Polygon polygon;
    if (inside.size() == 2) {
        polygon = {edgeBetween(inside[0], outside[0]), edgeBetween(inside[0], outside[1]),
                   edgeBetween(inside[1], outside[1]), edgeBetween(inside[1], outside[0])};
    } else {
        for (const int a : inside) {
            for (const int b : outside) polygon.push_back(edgeBetween(a, b));
        }
    }
    orient(polygon, inside, outside);
    return polygon;
}

/// Cuts polygons into triangles that hold at most one face diagonal each.
std::vector<Triangle> triangulate(const Polygon& polygon) {
    const auto body = std::find(polygon.begin(), polygon.end(), kBodyEdge);
    const std::size_t count = polygon.size();
    std::size_t first = 0;
    if (body != polygon.end()) {
        first = body - polygon.begin();
    } else if (count == 4 && !isAxisEdge(polygon[0])) {
        first = 1;
    }
    std::vector<Triangle> triangles;
    for (std::size_t k = 1; k + 1 < count; ++k) {
        triangles.push_back({polygon[first], polygon[(first + k) % count], polygon[(first + k + 1) % count]});
    }
    return triangles;
}

/// Turns the two triangles at a face diagonal, (d, q, x) and (d, x, p), into a row.
CellCase::Row pairUp(std::uint8_t diagonal, const std::vector<Triangle>& pair) {
    for (const int swap : {0, 1}) {
        const Triangle& a = pair[swap];
        const Triangle& b = pair[1 - swap];
        if (a[2] == b[1] && a[1] != b[2]) return {static_cast<std::int8_t>(diagonal), b[2], a[1], a[2]};
    }
    throw std::logic_error("two triangles at a face diagonal do not share an edge");
}

std::vector<CellCase::Row> makeRows(const std::vector<Triangle>& triangles) {
    std::vector<CellCase::Row> rows;
    std::map<std::uint8_t, std::vector<Triangle>> atDiagonal;
    for (Triangle triangle : triangles) {
        const auto special = std::find_if(triangle.begin(), triangle.end(), [](std::uint8_t edge) {
            return !isAxisEdge(edge) && edge != kBodyEdge;
        });
        const auto lead =
            special != triangle.end() ? special : std::find(triangle.begin(), triangle.end(), kBodyEdge);
        if (lead == triangle.end()) throw std::logic_error("a triangle holds axis crossings only");
        const bool plain = special == triangle.end();
        const std::size_t first = lead - triangle.begin();
        triangle = {triangle[first], triangle[(first + 1) % 3], triangle[(first + 2) % 3]};
        if (plain) {
            rows.push_back({-1, triangle[1], triangle[2], kBodyEdge});
        } else {
            atDiagonal[triangle[0]].push_back(triangle);
        }
    }
    for (const auto& [diagonal, pair] : atDiagonal) rows.push_back(pairUp(diagonal, pair));
    return rows;
}

bool shareFace(std::uint8_t a, std::uint8_t b) {
    const auto corners = [](std::uint8_t edge) {
        return 1 << kCellEdge[edge].corner | 1 << (kCellEdge[edge].corner | kCellEdge[edge].direction);
    };
    // Corner sets of the six faces.
    constexpr std::array<int, 6> kFaces = {0x55, 0xaa, 0x33, 0xcc, 0x0f, 0xf0};
    const int both = corners(a) | corners(b);
    return std::any_of(kFaces.begin(), kFaces.end(), [both](int face) { return (both & face) == both; });
}

/// First axis crossing of the loop around the body diagonal with no chord in a face; -1 if there is none.
std::int8_t findApex(const std::vector<CellCase::Row>& rows) {
    std::map<std::uint8_t, std::uint8_t> next;
    for (const CellCase::Row& row : rows) next[row.p] = row.q;
    for (const auto& link : next) {
        // Clang 14 cannot capture structured bindings.
        const std::uint8_t candidate = link.first;
        const std::uint8_t follower = link.second;
        const bool clear = std::all_of(next.begin(), next.end(), [&](const auto& other) {
            const bool chord =
                other.first != candidate && other.first != follower && other.second != candidate;
            return !chord || !shareFace(candidate, other.first);
        });
        if (clear) return static_cast<std::int8_t>(candidate);
    }
    return -1;
}

CellCase makeCase(int insideCorners) {
    CellCase cell;
    std::vector<Triangle> triangles;
    for (const auto& path : kPaths) {
        const Polygon polygon = crossTetrahedron(path, insideCorners);
        const std::vector<Triangle> part = triangulate(polygon);
        triangles.insert(triangles.end(), part.begin(), part.end());
    }
    cell.rows = makeRows(triangles);
    cell.crossesBody = (insideCorners & 1) != (insideCorners >> 7 & 1);
    if (cell.crossesBody) cell.apex = findApex(cell.rows);
    for (const CellCase::Row& row : cell.rows) {
        const auto x = row.x == kBodyEdge && cell.apex >= 0 ? static_cast<std::uint8_t>(cell.apex) : row.x;
        if (row.p != x && row.q != x) cell.compact.push_back({row.p, row.q, x});
    }
    return cell;
}

std::array<CellCase, 256> makeTable() {
    std::array<CellCase, 256> table;
    for (int insideCorners = 0; insideCorners < 256; ++insideCorners)
        table[insideCorners] = makeCase(insideCorners);
    return table;
}

}  // namespace

const std::array<CellCase, 256>& cellTable() {
    static const std::array<CellCase, 256> table = makeTable();
    return table;
}

}  // namespace isoglass
