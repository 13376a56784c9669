#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

namespace isoglass {

/// Bytes that the header of a classic NetCDF file (CDF-1, CDF-2, CDF-5) promises, without the padding
/// after the last value: a shorter file was cut off. Nothing for other formats, and for headers that end
/// early or contradict themselves (the NetCDF library refuses those).
///
/// Reference: NetCDF classic format specification (NUG, appendix B).
std::optional<std::uint64_t> classicNetcdfSize(const std::filesystem::path& path);

}  // namespace isoglass
