#pragma once

#include <filesystem>

// OpenVDB trusts what it reads: damaged masks or sizes make it write beyond its buffers. A seal at the
// end of the file, a checksum of all bytes before it, is checked before OpenVDB sees one of them. Readers
// of OpenVDB files go by offsets and never look at it. Private to the room.

namespace isoglass {

/// Appends the seal to a file that is complete but for it. Throws Error, naming `finalPath`, where the
/// disk does not take it.
void sealFile(const std::filesystem::path& path, const std::filesystem::path& finalPath);

/// Reads the whole file once, about a second a gigabyte. Throws Error where it is no OpenVDB file, has no
/// seal, or differs from what was sealed.
void checkSeal(const std::filesystem::path& path);

}  // namespace isoglass
