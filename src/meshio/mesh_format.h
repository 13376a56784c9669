#pragma once

#include <filesystem>
#include <optional>

namespace isoglass {

enum class MeshFormat { ply, obj, stl, off };

/// By the extension, in any case of letters; nothing for an unknown one.
std::optional<MeshFormat> knownMeshFormat(const std::filesystem::path& file);

/// The same. Throws Error that lists the known ones.
MeshFormat meshFormat(const std::filesystem::path& file);

/// As OpenMesh names it: ".ply".
const char* extensionOf(MeshFormat format);

}  // namespace isoglass
