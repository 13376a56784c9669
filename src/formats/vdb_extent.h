#pragma once

#include <filesystem>

namespace isoglass {

/// Refuses an OpenVDB file that ends before its grids do: OpenVDB reads on beyond the end of a file, for
/// minutes where the missing bytes would have been a size. What is no OpenVDB file of version 222 (2013) or
/// later with offsets of its grids passes. Throws Error.
///
/// Reference: OpenVDB, openvdb/io/Archive.cc and GridDescriptor.cc.
void requireWholeVdb(const std::filesystem::path& path);

}  // namespace isoglass
