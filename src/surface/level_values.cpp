#include "surface/level_values.h"

#include "basis/parallel.h"
#include "surface/blended_brick.h"
#include "surface/level_space.h"
#include "surface/size_field.h"

#include <algorithm>
#include <cmath>

namespace isoglass {

namespace {

constexpr std::size_t kVerticesPerTask = 4096;

/// Of a table that rises or falls.
int nearestIndex(const std::vector<double>& coordinate, int cells, double at) {
    const auto begin = coordinate.begin();
    const auto end = begin + cells + 1;
    const bool rises = coordinate[cells] >= coordinate[0];
    const auto after = std::partition_point(begin, end, [&](double c) { return rises ? c < at : c > at; });
    const auto index = static_cast<int>(after - begin);
    if (index == 0) return 0;
    if (index > cells) return cells;
    return std::abs(coordinate[index] - at) < std::abs(coordinate[index - 1] - at) ? index : index - 1;
}

float levelOfSize(float size, int top) {
    const int level = std::min(std::ilogb(size), top);
    if (level == top) return static_cast<float>(top);
    return static_cast<float>(level) + blendWeight(std::ldexp(size, -level));
}

}  // namespace

std::vector<float> levelAtVertices(const SurfaceMesh& mesh, const Lattice& lattice, const TimedField& field,
                                   const ExtractOptions& options) {
    std::vector<float> values(mesh.vertexCount());
    if (!hasDetail(lattice, options)) return values;
    const LevelSpace space(lattice);
    const SizeField sizes(space, *options.view, field, options.iso, options.threads);
    const glm::dvec3 shift = mesh.origin - space.levels[0].origin;
    parallelFor(values.size(), kVerticesPerTask, options.threads, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const glm::dvec3 position = shift + glm::dvec3(mesh.positions[i]);
            glm::ivec3 index;
            for (int k = 0; k < 3; ++k)
                index[k] = nearestIndex(space.coordinate[k], space.cells[k], position[k]);
            values[i] = levelOfSize(sizes.at(index), space.top());
        }
    });
    return values;
}

}  // namespace isoglass
