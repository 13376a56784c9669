#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace isoglass {

/// Checks that an array of a VTK XML file that is appended as raw bytes says of itself to have `bytes` bytes,
/// once decompressed: VTK's readers believe any size, and leave what they do not read as the memory was.
/// Arrays that are kept in another way, or in several pieces, pass. Throws Error.
void requireAppendedSize(const std::filesystem::path& file, const std::string& array, std::uint64_t bytes);

}  // namespace isoglass
