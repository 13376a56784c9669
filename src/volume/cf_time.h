#pragma once

#include "volume/cf_axes.h"
#include "volume/netcdf_file.h"
#include "volume/time_axis.h"

#include <string>
#include <vector>

namespace isoglass {

/// Reads the times of a variable's key frames: one, at 0, where it has no time dimension; 0, 1, 2, ...
/// where that has no coordinates. Where those have no dates, WRF's character variable `Times` gives them.
///
/// `replacement`, if not empty, takes the place of the times; units, calendar and cycle stay. A time axis
/// is cyclic where it has the attribute `modulo` or (CF section 7.4) `climatology`: the period is the
/// number in `modulo`, else the year of the calendar where the key frames cover one to 5 %, else the number
/// of key frames times their mean step. Units that are not units of time, or a date that does not exist,
/// are dropped. `notes` gets a sentence for each. Throws Error where times do not strictly increase or
/// `replacement` has another number of them.
TimeAxis readTimeAxis(const NetcdfFile& file, const NetcdfVariable& variable, const GridShape& shape,
                      const std::vector<double>& replacement, std::vector<std::string>& notes);

}  // namespace isoglass
