#pragma once

#include "volume/lattice.h"
#include "volume/netcdf_file.h"
#include "volume/staggering.h"

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace isoglass {

/// Which dimensions of a variable are x, y, z and time, as positions in `NetcdfVariable::dimensions`.
/// Dimensions of one sample that are none of these are left out.
struct GridShape {
    std::array<std::size_t, 3> axes;  ///< of x, y, z; each is longer than one sample
    std::optional<std::size_t> time;
    std::vector<CentredDimension> dimensions;  ///< all of the variable's, at the cell centres
    /// The variable with the coordinates of each dimension, null where there is none.
    std::vector<const NetcdfVariable*> coordinates;
};

/// Finds the shape by the CF attributes of the coordinate variables: `axis`, `units` (degrees east and
/// north, pressure, "... since ..."), `positive`, `standard_name`; a dimension named "time" is time.
/// What is left is taken from the last dimension to the first as x, y, z, time. Coordinates are the
/// variable of the dimension's name or one listed in the attribute `coordinates`. Nothing where the
/// variable is not numeric or has no three axes longer than one sample.
std::optional<GridShape> findShape(const NetcdfFile& file, const NetcdfVariable& variable);

/// Reads the coordinates of the dimension at `position`, or counts the samples where there are none: in
/// metres where the file has the step of WRF's projected grid (attributes `DX`, `DY`). Those of a staggered
/// dimension are brought to the centres.
/// Negates an axis that points down, makes a whole circle periodic, keeps a descending axis. Adds a
/// sentence to `notes` for each. Throws Error where coordinates are not finite or not strictly monotonic.
Axis readAxis(const NetcdfFile& file, const GridShape& shape, std::size_t position,
              std::vector<std::string>& notes);

/// The attribute `modulo` of a coordinate variable as a number, whether it is stored as one or as text.
/// Nothing where it is not finite and positive.
std::optional<double> numericModulo(const NetcdfFile& file, const NetcdfVariable& variable);

}  // namespace isoglass
