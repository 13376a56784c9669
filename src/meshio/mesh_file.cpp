#include "meshio/mesh_file.h"

#include "base/atomic_file.h"
#include "base/error.h"
#include "meshio/checked_stream.h"
#include "meshio/mesh_format.h"
#include "meshio/open_mesh.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cstring>
#include <limits>
#include <locale>
#include <optional>
#include <ostream>
#include <string>

namespace isoglass {

namespace {

constexpr std::array kExtensions{".ply", ".obj", ".stl", ".off"};
constexpr std::size_t kStlHeaderBytes = 80;

/// Shortest numerals that read back as the same doubles, at most 17 digits each.
std::string originText(const glm::dvec3& origin) {
    std::string text = "origin";
    for (int i = 0; i < 3; ++i) {
        std::array<char, 32> numeral;
        const auto end = std::to_chars(numeral.data(), numeral.data() + numeral.size(), origin[i]).ptr;
        text += ' ';
        text.append(numeral.data(), end);
    }
    return text;
}

void insertAfterLines(std::string& head, int lines, const std::string& text) {
    std::size_t place = 0;
    for (int line = 0; line < lines; ++line) place = head.find('\n', place) + 1;
    head.insert(place, text + "\n");
}

void commentPly(std::string& head, const std::string& text) {
    insertAfterLines(head, 2, "comment " + text);
}
void commentObj(std::string& head, const std::string& text) {
    insertAfterLines(head, 0, "# " + text);
}
void leaveHead(std::string&, const std::string&) {}

void nameTextStl(std::string& head, const std::string& text) {
    head.insert(std::strlen("solid "), text);
}

void fillBinaryStlHeader(std::string& head, const std::string& text) {
    std::string header = text;
    header.resize(kStlHeaderBytes, ' ');
    head.replace(0, kStlHeaderBytes, header);
}

CheckedStreambuf::EditHead headEditor(MeshFormat format, bool binary) {
    switch (format) {
        case MeshFormat::ply:
            return commentPly;
        case MeshFormat::obj:
            return commentObj;
        case MeshFormat::off:
            return leaveHead;
        case MeshFormat::stl:
            break;
    }
    return binary ? fillBinaryStlHeader : nameTextStl;
}

void checkCounts(const std::filesystem::path& file, const SurfaceMesh& mesh) {
    constexpr auto kMost = static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max());
    if (mesh.vertexCount() > kMost || mesh.triangleCount() > kMost) {
        throw Error("the mesh has more vertices or triangles than a mesh file can number (2147483647)",
                    file.string(), "extract a coarser surface or a part of the domain");
    }
}

}  // namespace

std::optional<MeshFormat> knownMeshFormat(const std::filesystem::path& file) {
    std::string extension = file.extension().string();
    std::ranges::transform(extension, extension.begin(),
                           [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
    const auto found = std::ranges::find(kExtensions, extension);
    if (found == kExtensions.end()) return std::nullopt;
    return static_cast<MeshFormat>(found - kExtensions.begin());
}

MeshFormat meshFormat(const std::filesystem::path& file) {
    if (const auto format = knownMeshFormat(file)) return *format;
    const std::string extension = file.extension().string();
    throw Error(extension.empty() ? "a mesh file needs an extension"
                                  : "no mesh format has the extension " + extension,
                file.string(), "use .ply, .obj, .stl or .off");
}

const char* extensionOf(MeshFormat format) {
    return kExtensions[static_cast<std::size_t>(format)];
}

void writeMesh(const std::filesystem::path& file, const SurfaceMesh& mesh, const MeshFileOptions& options) {
    const MeshFormat format = meshFormat(file);
    const bool hasBinary = format == MeshFormat::ply || format == MeshFormat::stl;
    const bool binary = hasBinary && options.encoding == MeshEncoding::binary;
    checkCounts(file, mesh);
    const std::string origin = originText(mesh.origin);
    if (format == MeshFormat::stl && binary && origin.size() > kStlHeaderBytes) {
        throw Error("the origin of the mesh does not fit into the header of a binary .stl file",
                    file.string(), "write .ply, or .stl as text");
    }

    SurfaceMeshExporter exporter(mesh);
    OpenMesh::IO::Options features;
    if (binary) features += OpenMesh::IO::Options::Binary;
    if (format != MeshFormat::stl && exporter.has_vertex_normals()) {
        features += OpenMesh::IO::Options::VertexNormal;
    }

    AtomicFile whole(file);
    CheckedStreambuf buffer(whole.temporaryPath(), headEditor(format, binary), origin);
    std::ostream stream(&buffer);
    stream.imbue(std::locale::classic());
    bool accepted = false;
    {
        const OpenMeshSession session;
        constexpr std::streamsize kDigits = std::numeric_limits<float>::max_digits10;
        accepted = OpenMesh::IO::IOManager().write(stream, extensionOf(format), exporter, features, kDigits);
    }
    // Behind the last face, where readers that know no comments (OpenMesh's is one) no longer look.
    if (format == MeshFormat::off) stream << "# " << origin << '\n' << std::flush;
    if (const int failure = buffer.finish(); failure != 0) {
        throw Error(std::string("cannot write the mesh: ") + std::strerror(failure), file.string(),
                    "free some space, or choose another place");
    }
    if (!accepted) throw Error("OpenMesh did not write the mesh", file.string());
    whole.commit();
}

}  // namespace isoglass
