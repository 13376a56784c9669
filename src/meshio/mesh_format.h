#pragma once

#include <filesystem>

namespace isoglass {

enum class MeshFormat { ply, obj, stl, off };

/// By the extension, in any case of letters. Throws Error that lists the known ones.
MeshFormat meshFormat(const std::filesystem::path& file);

/// As OpenMesh names it: ".ply".
const char* extensionOf(MeshFormat format);

}  // namespace isoglass
