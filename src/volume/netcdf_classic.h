#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

namespace isoglass {

/// Bytes that the header of a classic NetCDF file (CDF-1, CDF-2, CDF-5) promises, without the padding
/// after the last value: a shorter file was cut off. Nothing for other formats. Throws Error for a header
/// that ends early, contradicts itself or has a name of more than 256 bytes: the NetCDF library would read and
/// write beyond its buffers.
///
/// Reference: NetCDF classic format specification (NUG, appendix B).
std::optional<std::uint64_t> classicNetcdfSize(const std::filesystem::path& path);

}  // namespace isoglass
