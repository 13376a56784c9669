#include "surface/cell_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

namespace isoglass {
namespace {

using HalfEdge = std::pair<int, int>;

bool inside(int pattern, int corner) {
    return pattern >> corner & 1;
}

int edgeNumber(int cornerA, int cornerB) {
    for (int edge = 0; edge < kCellEdges; ++edge) {
        const int low = kCellEdge[edge].corner;
        const int high = low | kCellEdge[edge].direction;
        if ((low == cornerA && high == cornerB) || (low == cornerB && high == cornerA)) return edge;
    }
    return -1;
}

/// Corners of a face, counter-clockwise seen from outside the cell.
const std::array<std::array<int, 4>, 6> kFaces = {
    {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};

/// What the signs at a face's corners alone demand of the surface's boundary there, after leaving out
/// the crossing of the face's diagonal: segments with the inside on their right, seen from outside the
/// cell. A patch runs along its boundary that way when its normal points from inside to outside: with
/// corner 0 alone inside it is (x edge, y edge, z edge), and below the face z = 0 corner 0 lies right of
/// the step from the x edge to the y edge.
std::set<HalfEdge> faceContour(int pattern, const std::array<int, 4>& face) {
    // The Kuhn diagonal joins the lowest and the highest corner of the face.
    const int first = static_cast<int>(std::min_element(face.begin(), face.end()) - face.begin());
    const auto at = [&](int i) { return face[(first + i) % 4]; };
    std::map<int, int> next;
    for (const std::array<int, 3> triangle :
         {std::array{at(0), at(1), at(2)}, std::array{at(0), at(2), at(3)}}) {
        int leave = -1;
        int enter = -1;
        for (int k = 0; k < 3; ++k) {
            const int a = triangle[k];
            const int b = triangle[(k + 1) % 3];
            if (inside(pattern, a) && !inside(pattern, b)) leave = edgeNumber(a, b);
            if (!inside(pattern, a) && inside(pattern, b)) enter = edgeNumber(a, b);
        }
        if (enter >= 0) next[enter] = leave;
    }
    const int diagonal = edgeNumber(at(0), at(2));
    std::set<HalfEdge> contour;
    for (const auto& [from, to] : next) {
        if (from == diagonal) continue;
        contour.insert({from, to == diagonal ? next.at(diagonal) : to});
    }
    return contour;
}

std::set<HalfEdge> expectedBoundary(int pattern) {
    std::set<HalfEdge> boundary;
    for (const auto& face : kFaces) boundary.merge(faceContour(pattern, face));
    return boundary;
}

std::map<HalfEdge, int> halfEdges(const CellCase& cell) {
    std::map<HalfEdge, int> edges;
    for (const auto& triangle : cell.compact) {
        for (int k = 0; k < 3; ++k) ++edges[{triangle[k], triangle[(k + 1) % 3]}];
    }
    return edges;
}

std::set<HalfEdge> boundaryOf(const std::map<HalfEdge, int>& edges) {
    std::set<HalfEdge> boundary;
    for (const auto& [edge, count] : edges) {
        if (!edges.contains({edge.second, edge.first})) boundary.insert(edge);
    }
    return boundary;
}

bool inOneFace(int edgeA, int edgeB) {
    const auto holds = [](const std::array<int, 4>& face, int edge) {
        const int low = kCellEdge[edge].corner;
        const int high = low | kCellEdge[edge].direction;
        return std::count(face.begin(), face.end(), low) && std::count(face.begin(), face.end(), high);
    };
    return std::any_of(kFaces.begin(), kFaces.end(),
                       [&](const auto& face) { return holds(face, edgeA) && holds(face, edgeB); });
}

int countLoops(const std::set<HalfEdge>& boundary) {
    std::map<int, int> next(boundary.begin(), boundary.end());
    int loops = 0;
    while (!next.empty()) {
        ++loops;
        for (auto it = next.begin(); it != next.end();) {
            const int to = it->second;
            next.erase(it);
            it = next.find(to);
        }
    }
    return loops;
}

TEST(CellTable, EdgesAreNumberedByKind) {
    for (int edge = 0; edge < kCellEdges; ++edge) {
        const int bits = __builtin_popcount(kCellEdge[edge].direction);
        EXPECT_EQ(kCellEdge[edge].corner & kCellEdge[edge].direction, 0) << edge;
        EXPECT_EQ(bits, edge < kAxisEdges ? 1 : edge < kBodyEdge ? 2 : 3) << edge;
    }
}

TEST(CellTable, VerticesLieOnCrossedEdges) {
    for (int pattern = 0; pattern < 256; ++pattern) {
        for (const auto& triangle : cellTable()[pattern].compact) {
            for (const int edge : triangle) {
                const int low = kCellEdge[edge].corner;
                EXPECT_NE(inside(pattern, low), inside(pattern, low | kCellEdge[edge].direction)) << pattern;
                EXPECT_TRUE(edge < kAxisEdges ||
                            (edge == kBodyEdge && cellTable()[pattern].needsBodyVertex()));
            }
        }
    }
}

TEST(CellTable, EveryCrossedAxisEdgeIsUsed) {
    for (int pattern = 0; pattern < 256; ++pattern) {
        std::set<int> used;
        for (const auto& triangle : cellTable()[pattern].compact)
            used.insert(triangle.begin(), triangle.end());
        for (int edge = 0; edge < kAxisEdges; ++edge) {
            const int low = kCellEdge[edge].corner;
            const bool crossed = inside(pattern, low) != inside(pattern, low | kCellEdge[edge].direction);
            EXPECT_EQ(used.contains(edge), crossed) << "pattern " << pattern << " edge " << edge;
        }
    }
}

// Two cells that share a face see the same four signs, so a boundary that follows from a face's signs
// alone closes the surface across every face.
TEST(CellTable, BoundaryFollowsFromTheFaceSignsAlone) {
    for (int pattern = 0; pattern < 256; ++pattern) {
        EXPECT_EQ(boundaryOf(halfEdges(cellTable()[pattern])), expectedBoundary(pattern)) << pattern;
    }
}

TEST(CellTable, OppositeFacesDemandOppositeContours) {
    // Face 0 (x = 0) of a cell is face 1 (x = 1) of the one before it: the contours must cancel.
    constexpr std::array<int, 3> kBit = {1, 2, 4};
    for (int axis = 0; axis < 3; ++axis) {
        for (int pattern = 0; pattern < 256; ++pattern) {
            int shifted = 0;
            for (int corner = 0; corner < 8; ++corner) {
                if (!(corner & kBit[axis]) && inside(pattern, corner)) shifted |= 1 << (corner | kBit[axis]);
            }
            std::set<HalfEdge> turned;
            const auto moved = [&](int edge) {
                const int low = kCellEdge[edge].corner | kBit[axis];
                return edgeNumber(low, low | kCellEdge[edge].direction);
            };
            for (const auto& [from, to] : faceContour(pattern, kFaces[2 * axis])) {
                turned.insert({moved(to), moved(from)});
            }
            EXPECT_EQ(turned, faceContour(shifted, kFaces[2 * axis + 1]))
                << "axis " << axis << " " << pattern;
        }
    }
}

TEST(CellTable, PatchesAreManifold) {
    for (int pattern = 0; pattern < 256; ++pattern) {
        for (const auto& [edge, count] : halfEdges(cellTable()[pattern])) {
            EXPECT_EQ(count, 1) << "pattern " << pattern;
            EXPECT_NE(edge.first, edge.second) << "pattern " << pattern;
        }
    }
}

// A chord inside a face could be drawn by the cell on the other side too: four triangles at one edge.
TEST(CellTable, NoInnerChordLiesInAFace) {
    for (int pattern = 0; pattern < 256; ++pattern) {
        const auto edges = halfEdges(cellTable()[pattern]);
        for (const auto& [edge, count] : edges) {
            if (!edges.contains({edge.second, edge.first})) continue;
            EXPECT_FALSE(inOneFace(edge.first, edge.second)) << "pattern " << pattern;
        }
    }
}

TEST(CellTable, CountsAreThoseOfTheMethod) {
    std::map<int, int> loops;
    std::set<int> tubes;
    int stars = 0;
    std::size_t mostRows = 0;
    std::size_t mostTriangles = 0;
    for (int pattern = 0; pattern < 256; ++pattern) {
        const CellCase& cell = cellTable()[pattern];
        const auto edges = halfEdges(cell);
        const int boundaryLoops = countLoops(boundaryOf(edges));
        if (boundaryLoops > 0) ++loops[boundaryLoops];
        stars += cell.needsBodyVertex();
        mostRows = std::max(mostRows, cell.rows.size());
        mostTriangles = std::max(mostTriangles, cell.compact.size());
        // Euler number V - E + F is one a disk; a tube of two loops has 0.
        std::set<int> vertices;
        std::set<HalfEdge> whole;
        for (const auto& [edge, count] : edges) {
            vertices.insert(edge.first);
            whole.insert(std::minmax(edge.first, edge.second));
        }
        const int euler = static_cast<int>(vertices.size()) - static_cast<int>(whole.size()) +
                          static_cast<int>(cell.compact.size());
        if (euler != boundaryLoops) tubes.insert(pattern);
    }
    EXPECT_EQ(loops, (std::map<int, int>{{1, 188}, {2, 62}, {3, 4}}));
    EXPECT_EQ(tubes, (std::set<int>{126, 129}));
    EXPECT_EQ(stars, 14);
    EXPECT_EQ(mostRows, 12u);
    EXPECT_EQ(mostTriangles, 12u);
}

TEST(CellTable, ComplementTurnsThePatchAround) {
    for (int pattern = 0; pattern < 256; ++pattern) {
        std::set<HalfEdge> turned;
        for (const auto& edge : boundaryOf(halfEdges(cellTable()[255 - pattern]))) {
            turned.insert({edge.second, edge.first});
        }
        EXPECT_EQ(boundaryOf(halfEdges(cellTable()[pattern])), turned) << pattern;
    }
}

}  // namespace
}  // namespace isoglass
