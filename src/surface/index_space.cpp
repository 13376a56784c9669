#include "surface/index_space.h"

#include "volume/key_frame.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace isoglass {

namespace {

/// World step from lattice sample i to i + 1, also across the ends of a periodic axis; NaN where there
/// is none.
double step(const Axis& axis, int i) {
    const int cells = static_cast<int>(axis.cells());
    if (cells == 0) return std::numeric_limits<double>::quiet_NaN();
    if (axis.period) i = (i + cells) % cells;
    if (i < 0 || i >= cells) return std::numeric_limits<double>::quiet_NaN();
    return axis.coordinate(i + 1) - axis.coordinate(i);
}

AxisTable makeTable(const Axis& axis, double origin) {
    AxisTable table;
    for (int i = 0; i <= static_cast<int>(axis.cells()); ++i) {
        const double before = step(axis, i - 1);
        const double after = step(axis, i);
        table.coordinate.push_back(axis.coordinate(i) - origin);
        table.previous.push_back(static_cast<float>(after / (before * (before + after))));
        table.next.push_back(static_cast<float>(before / (after * (before + after))));
        table.inversePrevious.push_back(static_cast<float>(1 / before));
        table.inverseNext.push_back(static_cast<float>(1 / after));
    }
    return table;
}

}  // namespace

IndexSpace::IndexSpace(const Lattice& lattice)
    : stored(lattice.dims()),
      cells(lattice.cells()),
      bricks((cells + kBrickSize) / kBrickSize),
      mirrored(lattice.mirrored()),
      origin(meshOrigin(lattice)) {
    for (int k = 0; k < 3; ++k) {
        periodic[k] = lattice.axes[k].period.has_value();
        axes[k] = makeTable(lattice.axes[k], origin[k]);
    }
}

int IndexSpace::storedIndex(int axis, int i) const {
    const int count = stored[axis];
    if (periodic[axis]) return i > cells[axis] + 1 ? -1 : (i + count) % count;
    return i >= 0 && i < count ? i : -1;
}

glm::dvec3 meshOrigin(const Lattice& lattice) {
    constexpr double kResolvedPart = 1.0 / 1024;
    bool fine = true;
    const auto corners = lattice.bounds();
    for (int k = 0; k < 3; ++k) {
        const Axis& axis = lattice.axes[k];
        double largest = std::max(std::abs(corners[0][k]), std::abs(corners[1][k]));
        double smallestStep = std::numeric_limits<double>::infinity();
        for (std::size_t i = 1; i <= axis.cells(); ++i)
            smallestStep = std::min(smallestStep, std::abs(axis.coordinate(i) - axis.coordinate(i - 1)));
        fine = fine && largest * std::numeric_limits<float>::epsilon() <= smallestStep * kResolvedPart;
    }
    if (fine) return glm::dvec3(0);
    glm::dvec3 middle;
    for (int k = 0; k < 3; ++k) middle[k] = std::round(0.5 * (corners[0][k] + corners[1][k]));
    return middle;
}

}  // namespace isoglass
