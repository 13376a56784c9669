#pragma once

#include "base/atomic_file.h"
#include "volume/series_description.h"

#include <openvdb/openvdb.h>

#include <filesystem>

// Private to the room: it includes OpenVDB.

namespace isoglass {

/// Writes the grids of a series, one a key frame and named by `gridName`, with its complete description to
/// `file`, seals it, reads all of it back and commits it. `out` is the name for messages. Throws Error.
void saveSeries(const SeriesDescription& series, const openvdb::GridPtrVec& grids, AtomicFile& file,
                const std::filesystem::path& out);

}  // namespace isoglass
