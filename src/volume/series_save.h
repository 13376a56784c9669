#pragma once

#include "base/atomic_file.h"
#include "volume/key_frame.h"
#include "volume/series_description.h"

#include <openvdb/openvdb.h>

#include <cstddef>
#include <filesystem>
#include <vector>

// Private to the room: it includes OpenVDB.

namespace isoglass {

/// Appends grids with all coarser levels of key frame `frame` of a series, and of its heights, to `grids`.
/// Returns what is known of them.
std::vector<LevelRecord> addLevelGrids(const SeriesDescription& series, std::size_t frame,
                                       const KeyFrame& keyFrame, openvdb::GridPtrVec& grids);

/// Writes the grids of a series, named by `gridName` and its like, with its complete description to
/// `file`, seals it, reads all of it back and commits it. `out` is the name for messages. Throws Error.
void saveSeries(const SeriesDescription& series, const openvdb::GridPtrVec& grids, AtomicFile& file,
                const std::filesystem::path& out);

}  // namespace isoglass
