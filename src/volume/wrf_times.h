#pragma once

#include "volume/netcdf_file.h"
#include "volume/time_axis.h"

#include <optional>
#include <string>
#include <vector>

namespace isoglass {

/// Reads the dates that the WRF model writes as text, one a time step: the variable `Times` of characters,
/// along `timeDimension`, each "2005-08-28_12:00:00". They become minutes since the first one, in the
/// standard calendar. Nothing, with a note where it is there but holds no dates, for other files. Throws
/// Error.
std::optional<TimeAxis> readWrfTimes(const NetcdfFile& file, int timeDimension,
                                     std::vector<std::string>& notes);

}  // namespace isoglass
