#include "surface/level_space.h"

#include "volume/pyramid.h"

#include <algorithm>
#include <cmath>

namespace isoglass {

namespace {

/// The samples that a level keeps: every 2^level-th and the last. A periodic axis is cut open.
Lattice latticeOf(const Lattice& lattice, int level) {
    Lattice coarse;
    for (int k = 0; k < 3; ++k) {
        const std::size_t cells = lattice.axes[k].cells();
        const std::size_t step = std::size_t{1} << level;
        for (std::size_t i = 0; i < cells + step; i += step) {
            coarse.axes[k].coordinates.push_back(lattice.axes[k].coordinate(std::min(i, cells)));
            if (i >= cells) break;
        }
    }
    return coarse;
}

}  // namespace

LevelSpace::LevelSpace(const Lattice& lattice) : cells(lattice.cells()), largestStep{} {
    const int topmost = topLevel(cells);
    levels.emplace_back(lattice);
    for (int level = 1; level <= topmost; ++level) levels.emplace_back(latticeOf(lattice, level));
    const int padded = kBrickSize << topmost;
    for (int k = 0; k < 3; ++k) {
        std::vector<double>& table = coordinate[k];
        table = levels[0].axes[k].coordinate;
        for (std::size_t i = 1; i < table.size(); ++i)
            largestStep[k] = std::max(largestStep[k], std::abs(table[i] - table[i - 1]));
        const double end = table.back();
        const double step = table.size() > 1 ? end - table[table.size() - 2] : 0;
        for (int i = 1; static_cast<int>(table.size()) <= padded; ++i) table.push_back(end + i * step);
    }
}

}  // namespace isoglass
