#include "volume/lattice_check.h"

#include "base/error.h"

#include <cmath>

namespace isoglass {

void requireUsable(const Lattice& lattice, const std::string& place) {
    for (const Axis& axis : lattice.axes) {
        for (std::size_t i = 0; i <= axis.cells(); ++i) {
            const auto fail = [&](const std::string& what) {
                throw Error(what, place + ", axis " + axis.name + ", index " + std::to_string(i),
                            "choose other units");
            };
            const double coordinate = axis.coordinate(i);
            if (std::abs(coordinate) > kLargestCoordinate) fail("the coordinate is beyond 1e30");
            if (i > 0 && std::abs(coordinate - axis.coordinate(i - 1)) < kSmallestStep)
                fail("the step to the coordinate is below 1e-30");
        }
    }
}

}  // namespace isoglass
