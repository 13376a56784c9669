#pragma once

#include "volume/series_file.h"

#include <filesystem>
#include <memory>
#include <span>

namespace isoglass {

/// Opens one series that lies in one or more files of IsoGlass, by their names or by patterns with * and ?
/// in the name of the file.
///
/// Several files must agree in name, units, lattice, time units, calendar and period; their key frames are
/// put in the order of their times, which must all differ. Files with one key frame are not kept open, so
/// there may be more of them than a process may open. Throws Error that names the file: where a pattern
/// matches nothing, a file cannot be read or is damaged, or does not go with the first one.
std::shared_ptr<const SeriesFile> openSeriesSet(std::span<const std::filesystem::path> names);

}  // namespace isoglass
