#include "surface/cell_solid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

namespace isoglass {
namespace {

using DirectedEdge = std::pair<int, int>;

template <typename Use>
void forEachEdge(const CellSolid::Polygon& polygon, Use use) {
    for (std::size_t i = 0; i < polygon.points.size(); ++i)
        use(DirectedEdge(polygon.points[i], polygon.points[(i + 1) % polygon.points.size()]));
}

TEST(CellSolid, IsClosedForEveryPattern) {
    for (int pattern = 0; pattern < 256; ++pattern) {
        std::map<DirectedEdge, int> count;
        for (const CellSolid::Polygon& polygon : cellSolids()[pattern].polygons) {
            EXPECT_GE(polygon.points.size(), 3u);
            EXPECT_EQ(std::set(polygon.points.begin(), polygon.points.end()).size(), polygon.points.size());
            forEachEdge(polygon, [&](DirectedEdge edge) { ++count[edge]; });
        }
        for (const auto& [edge, times] : count) {
            EXPECT_EQ(times, 1) << "pattern " << pattern;
            EXPECT_TRUE(count.contains({edge.second, edge.first})) << "pattern " << pattern;
        }
        EXPECT_EQ(count.empty(), pattern == 0);
    }
}

/// Else a cut could close a loop of two points.
TEST(CellSolid, NoTwoPolygonsShareTwoEdges) {
    for (int pattern = 0; pattern < 256; ++pattern) {
        std::map<DirectedEdge, std::size_t> owner;
        const auto& polygons = cellSolids()[pattern].polygons;
        for (std::size_t i = 0; i < polygons.size(); ++i)
            forEachEdge(polygons[i], [&](DirectedEdge edge) { owner[edge] = i; });
        std::set<std::pair<std::size_t, std::size_t>> pairs;
        for (const auto& [edge, i] : owner) {
            if (edge.first > edge.second) continue;
            EXPECT_TRUE(pairs.insert(std::minmax(i, owner.at({edge.second, edge.first}))).second)
                << "pattern " << pattern;
        }
    }
}

/// The point of the cell before along `axis` that lies where `point`, in this cell's low face, does; by the
/// corners that the point lies between.
std::pair<int, int> ends(int point) {
    static const auto kEnds = [] {
        std::map<int, std::pair<int, int>> all;
        for (int corner = 0; corner < 8; ++corner) all[corner] = {corner, corner};
        int name = kFirstCrossing;
        for (const int direction : {1, 2, 4}) {
            for (int corner = 0; corner < 8; ++corner) {
                if (!(corner & direction)) all[name++] = {corner, corner | direction};
            }
        }
        return all;
    }();
    return kEnds.at(point);
}

TEST(CellSolid, FacesOfTouchingCellsAreMirrorImages) {
    for (int axis = 0; axis < 3; ++axis) {
        const int bit = 1 << axis;
        for (int before = 0; before < 256; ++before) {
            // Any pattern of the cell behind whose low corners are this cell's high ones.
            int behind = 0;
            for (int corner = 0; corner < 8; ++corner) {
                if (!(corner & bit)) behind |= (before >> (corner | bit) & 1) << corner;
            }
            using Edge = std::pair<std::pair<int, int>, std::pair<int, int>>;
            std::set<Edge> high, low;
            for (const auto& polygon : cellSolids()[before].polygons) {
                if (polygon.face != 2 * axis + 1) continue;
                forEachEdge(polygon, [&](DirectedEdge edge) {
                    auto [a, b] = std::pair(ends(edge.first), ends(edge.second));
                    for (auto* end : {&a, &b}) *end = {end->first & ~bit, end->second & ~bit};
                    high.insert({b, a});
                });
            }
            for (const int rest : {0, 255}) {
                int pattern = behind;
                for (int corner = 0; corner < 8; ++corner) {
                    if (corner & bit) pattern |= rest & 1 << corner;
                }
                low.clear();
                for (const auto& polygon : cellSolids()[pattern].polygons) {
                    if (polygon.face != 2 * axis) continue;
                    forEachEdge(polygon, [&](DirectedEdge edge) {
                        low.insert({ends(edge.first), ends(edge.second)});
                    });
                }
                EXPECT_EQ(high, low) << "axis " << axis << ", pattern " << before;
            }
        }
    }
}

}  // namespace
}  // namespace isoglass
