#include "surface/enclosed_volume.h"

#include "basis/parallel.h"
#include "surface/brick_field.h"
#include "surface/index_space.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <vector>

namespace isoglass {

namespace {

constexpr std::size_t kBricksPerTask = 64;

/// Corners 0, i, i + j, 7 of a cell for the six orders of its axes; corner c lies at (c & 1, c >> 1 & 1,
/// c >> 2).
constexpr std::array<std::array<int, 4>, 6> kTetrahedra = {
    {{0, 1, 3, 7}, {0, 1, 5, 7}, {0, 2, 3, 7}, {0, 2, 6, 7}, {0, 4, 5, 7}, {0, 4, 6, 7}}};

/// Where the edge from a to b is crossed, from 0 at a: they lie on different sides of 0.
double crossing(double a, double b) {
    return a / (a - b);
}

/// The share of a tetrahedron where the linear function with these corner values is at least 0.
double insideShare(std::array<double, 4> value) {
    std::sort(value.begin(), value.end(), std::greater<>());
    const auto [a, b, c, d] = value;
    if (d >= 0) return 1;
    if (a < 0) return 0;
    if (b < 0) return crossing(a, b) * crossing(a, c) * crossing(a, d);
    if (c >= 0) return 1 - crossing(d, a) * crossing(d, b) * crossing(d, c);
    // A wedge between the triangles (a, ac, ad) and (b, bc, bd): three tetrahedra.
    const double ac = crossing(a, c), ad = crossing(a, d), bc = crossing(b, c), bd = crossing(b, d);
    return ac * ad + bc * (1 - ac) * ad + bc * bd * (1 - ad);
}

/// Lengths along the third axis from corners 0 to 3 of a cell to corners 4 to 7.
using Columns = std::array<double, 4>;

/// The volume inside a cell, over `area`, whose columns have these lengths. A tetrahedron walks along one
/// of the four columns, the one of the corner below its step upwards, so its volume is a sixth of that
/// column's length times the area, however the columns are sheared against each other.
double insideCell(const std::array<double, 8>& value, const Columns& length, double area) {
    const auto [low, high] = std::minmax_element(value.begin(), value.end());
    if (*high < 0) return 0;
    const bool whole = *low >= 0;
    double sum = 0;
    for (const auto& corner : kTetrahedra) {
        const int column = corner[2] < 4 ? corner[2] : corner[1] < 4 ? corner[1] : corner[0];
        const double share =
            whole ? 1 : insideShare({value[corner[0]], value[corner[1]], value[corner[2]], value[corner[3]]});
        sum += length[column] * share;
    }
    return sum * area / 6;
}

/// How far a sample lies from the next one in its column.
double heightBetween(const BrickField& heights, glm::ivec3 low) {
    const double bottom = heights.values[BrickField::at(low.x, low.y, low.z)];
    return std::abs(heights.values[BrickField::at(low.x, low.y, low.z + 1)] - bottom);
}

/// `heights` is null where the third axis table says where the samples are.
void addBrick(const IndexSpace& space, glm::ivec3 brick, const BrickField& field, const BrickField* heights,
              double iso, EnclosedVolume& sum) {
    const glm::ivec3 first = brick * kBrickSize;
    const auto length = [&](int axis, int i) {
        const std::vector<double>& coordinate = space.axes[axis].coordinate;
        return std::abs(coordinate[i + 1] - coordinate[i]);
    };
    const auto count = [&](int axis) { return std::min(kBrickSize, space.cells[axis] - first[axis]); };
    for (int x = 0; x < count(0); ++x) {
        for (int y = 0; y < count(1); ++y) {
            const double area = length(0, first.x + x) * length(1, first.y + y);
            for (int z = 0; z < count(2); ++z) {
                std::array<double, 8> value;
                bool whole = true;
                for (int corner = 0; corner < 8; ++corner) {
                    const float sample = field.values[BrickField::at(x + (corner & 1), y + (corner >> 1 & 1),
                                                                     z + (corner >> 2))];
                    value[corner] = static_cast<double>(sample) - iso;
                    whole = whole && !std::isnan(sample);
                }
                if (!whole) {
                    ++sum.missingCells;
                    continue;
                }
                Columns column;
                for (int corner = 0; corner < 4; ++corner) {
                    column[corner] = heights
                                         ? heightBetween(*heights, {x + (corner & 1), y + (corner >> 1), z})
                                         : length(2, first.z + z);
                }
                sum.domain += insideCell({}, column, area);
                sum.volume += insideCell(value, column, area);
            }
        }
    }
}

}  // namespace

EnclosedVolume enclosedVolume(const Lattice& lattice, const TimedField& field,
                              const ExtractOptions& options) {
    const IndexSpace space(lattice);
    const float sign = options.insideIsBelow ? -1.0f : 1.0f;
    const KeyFrame& any = field.a ? *field.a : *field.b;
    const TimedField heights{field.a ? field.a->heights() : nullptr, field.b ? field.b->heights() : nullptr,
                             field.fraction};
    const std::size_t bricks = static_cast<std::size_t>(space.bricks.x) * space.bricks.y * space.bricks.z;
    std::vector<EnclosedVolume> parts((bricks + kBricksPerTask - 1) / kBricksPerTask);
    parallelFor(bricks, kBricksPerTask, options.threads, [&](std::size_t begin, std::size_t end) {
        BrickField gathered;
        BrickField gatheredHeights;
        BrickField scratch;
        for (std::size_t i = begin; i < end; ++i) {
            const glm::ivec3 brick(i % space.bricks.x, i / space.bricks.x % space.bricks.y,
                                   i / (static_cast<std::size_t>(space.bricks.x) * space.bricks.y));
            gatherBrick(space, field, brick, sign, scratch, gathered);
            if (any.heights()) gatherBrick(space, heights, brick, 1, scratch, gatheredHeights);
            addBrick(space, brick, gathered, any.heights() ? &gatheredHeights : nullptr,
                     static_cast<double>(sign) * options.iso, parts[begin / kBricksPerTask]);
        }
    });
    EnclosedVolume sum;
    for (const EnclosedVolume& part : parts) {
        sum.volume += part.volume;
        sum.domain += part.domain;
        sum.missingCells += part.missingCells;
    }
    return sum;
}

}  // namespace isoglass
