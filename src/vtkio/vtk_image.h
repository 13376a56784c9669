#pragma once

#include "volume/frame_source.h"

#include <filesystem>
#include <memory>
#include <span>
#include <vector>

namespace isoglass {

/// Opens VTK image data (.vti, or .pvti in pieces), one key frame a file. `options.variable` names a point or
/// cell array, where there are several; "NAME:2" is the third component of a vector. Samples of cells lie
/// in their middles. Times are those of a field `TimeValue` or `TimeStep` where every file has one. Points
/// that are hidden (`vtkGhostType`) are missing. Read in a process of its own (`openIsolated`), and every
/// error that VTK reports is one. Throws Error.
std::unique_ptr<FrameSource> openVtkImages(std::span<const std::filesystem::path> files,
                                           const ImportOptions& options);

/// The same with a time for each file, which `options.times` overrules; empty as `openVtkImages`.
std::unique_ptr<FrameSource> openVtkSequence(std::span<const std::filesystem::path> files,
                                             const std::vector<double>& times, const ImportOptions& options);

/// Opens an index of such files with their times: ParaView's .pvd, or .vti.series. Throws Error.
std::unique_ptr<FrameSource> openVtkSeries(const std::filesystem::path& index, const ImportOptions& options);

}  // namespace isoglass
