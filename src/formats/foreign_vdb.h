#pragma once

#include "volume/frame_source.h"

#include <filesystem>
#include <memory>
#include <span>

namespace isoglass {

/// Opens OpenVDB files from elsewhere, one key frame each: grids of float or double, chosen by
/// `options.variable` where a file has several. The lattice is the box around the active voxels of all
/// files and one voxel more on every side, so that a surface between active voxels and background closes;
/// an inactive voxel has the value that the tree holds for it. The transform must be linear; it becomes
/// axes as `orient` says. Read in a process of its own (`openIsolated`). The format has no checksums: a
/// changed sample cannot be noticed. Throws Error.
std::unique_ptr<FrameSource> openForeignVdb(std::span<const std::filesystem::path> files,
                                            const ImportOptions& options);

}  // namespace isoglass
