#pragma once

#include "volume/netcdf_file.h"

#include <cstddef>
#include <string>

namespace isoglass {

/// A dimension of a variable as it is at the centres of the cells.
struct CentredDimension {
    std::string name;  ///< of the dimension that runs over cell centres
    std::size_t length = 0;
    bool staggered = false;  ///< the variable itself has one sample more, on the faces between centres
};

/// How dimension `position` of `variable` lies to the cell centres, by the convention of the WRF model: a
/// dimension NAME_stag runs over the faces between the centres along NAME, which has one sample less. NAME
/// must be a dimension of that length, or one of WRF's own that the file left out (west_east, south_north,
/// bottom_top); an empty attribute `stagger` says that the variable is not staggered after all.
CentredDimension centredDimension(const NetcdfFile& file, const NetcdfVariable& variable,
                                  std::size_t position);

}  // namespace isoglass
