#pragma once

#include "mesh/surface_mesh.h"

#include <cstddef>
#include <filesystem>

namespace isoglass {

/// How numbers are written where a format has both ways (.ply, .stl). .obj and .off are always text.
enum class MeshEncoding { binary, text };

struct MeshFileOptions {
    MeshEncoding encoding = MeshEncoding::binary;
};

/// Writes `mesh` as .ply, .obj, .stl or .off, by the extension.
///
/// Every triangle is written as it is, zero-area and non-manifold ones included, in the order and with
/// the winding of `mesh`; .stl has no shared vertices. Positions are single precision and relative to
/// `mesh.origin`, which the file states with as many digits as it takes to read back the same doubles:
/// a comment "origin X Y Z", in binary .stl the 80-byte header. Normals are written with length 1 (.ply,
/// .obj, .off; those of facets in .stl, zero for a triangle without area). Text has 9 digits, enough
/// for the same floats. An empty mesh makes a valid file without vertices: whether that is worth a
/// warning only the caller knows.
///
/// The file appears under its name only when all bytes are on the disk; on failure an older file stays
/// as it was and nothing else is left. Throws Error: unknown extension, folder that cannot be written,
/// full disk, more than 2^31 - 1 vertices or triangles. Any thread; one file at a time.
void writeMesh(const std::filesystem::path& file, const SurfaceMesh& mesh,
               const MeshFileOptions& options = {});

/// What a mesh file holds that a mesh of triangles does not.
struct MeshFileLosses {
    std::size_t polygons = 0;  ///< faces with more than three corners: each is now a fan of triangles
    std::size_t refused = 0;   ///< faces that were left out: they name one position twice
};

/// Reads a file that `writeMesh` or another program wrote: .ply, .obj, .stl, .off (text).
///
/// Polygons become fans of triangles; `losses`, where it is given, tells how many. `origin` is what the file
/// states, else 0. `normals` are empty where the file does not have one for every vertex, or several that
/// differ, and for .off, whose normals OpenMesh skips. The triangles of an .stl file share a vertex where
/// they name the same position; those that name one position twice are refused, and counted likewise. Throws
/// Error: file that cannot be read, is damaged, or ends early (which an .obj file does not show), unknown
/// extension. The global locale of C++ must be the classic one, which it is unless a program sets it. Any
/// thread; one file at a time.
SurfaceMesh readMesh(const std::filesystem::path& file, MeshFileLosses* losses = nullptr);

}  // namespace isoglass
