#include "volume/lattice.h"

#include <algorithm>

namespace isoglass {

double Axis::coordinate(std::size_t index) const {
    if (index < size()) return coordinates[index];
    return coordinates.front() + (descending() ? -*period : *period);
}

glm::ivec3 Lattice::dims() const {
    return {static_cast<int>(axes[0].size()), static_cast<int>(axes[1].size()),
            static_cast<int>(axes[2].size())};
}

glm::ivec3 Lattice::cells() const {
    return {static_cast<int>(axes[0].cells()), static_cast<int>(axes[1].cells()),
            static_cast<int>(axes[2].cells())};
}

bool Lattice::mirrored() const {
    return std::count_if(axes.begin(), axes.end(), [](const Axis& axis) { return axis.descending(); }) % 2 ==
           1;
}

std::array<glm::dvec3, 2> Lattice::bounds() const {
    std::array<glm::dvec3, 2> corners;
    for (int k = 0; k < 3; ++k) {
        const double first = axes[k].coordinate(0);
        const double last = axes[k].coordinate(axes[k].cells());
        corners[0][k] = std::min(first, last);
        corners[1][k] = std::max(first, last);
    }
    if (heights) {
        corners[0].z = heights->min;
        corners[1].z = heights->max;
    }
    return corners;
}

Lattice makeUniformLattice(glm::ivec3 dims, glm::dvec3 origin, glm::dvec3 spacing) {
    Lattice lattice;
    for (int k = 0; k < 3; ++k) {
        Axis& axis = lattice.axes[k];
        axis.name = std::string(1, static_cast<char>('x' + k));
        axis.coordinates.resize(dims[k]);
        for (int i = 0; i < dims[k]; ++i) axis.coordinates[i] = origin[k] + i * spacing[k];
    }
    return lattice;
}

}  // namespace isoglass
