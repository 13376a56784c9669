#include "base/error.h"
#include "meshio/mesh_file.h"
#include "meshio/mesh_format.h"
#include "meshio/open_mesh.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <exception>
#include <fstream>
#include <locale>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>

namespace isoglass {

namespace {

constexpr std::size_t kStlHeaderBytes = 80;
constexpr std::size_t kFirstLineBytes = 200;  // longer than any line that states an origin

/// The origin that a line "origin X Y Z" states, behind whatever marks a comment.
std::optional<glm::dvec3> originIn(std::string_view line) {
    constexpr std::string_view kMarks[] = {"comment ", "# ", "solid "};
    for (const std::string_view mark : kMarks) {
        if (line.starts_with(mark)) {
            line.remove_prefix(mark.size());
            break;
        }
    }
    constexpr std::string_view kWord = "origin";
    if (!line.starts_with(kWord)) return std::nullopt;
    line.remove_prefix(kWord.size());
    glm::dvec3 origin;
    for (int i = 0; i < 3; ++i) {
        if (!line.starts_with(' ')) return std::nullopt;
        line.remove_prefix(1);
        const auto [end, error] = std::from_chars(line.data(), line.data() + line.size(), origin[i]);
        if (error != std::errc()) return std::nullopt;
        line.remove_prefix(static_cast<std::size_t>(end - line.data()));
    }
    return line.find_first_not_of(" \r") == std::string_view::npos ? std::optional(origin) : std::nullopt;
}

/// What a .ply header declares, and OpenMesh reads but does not hold the file to.
struct Declared {
    std::uint64_t vertices = 0;
    std::uint64_t faces = 0;
};

Declared readPlyHeader(std::istream& stream, glm::dvec3& origin) {
    Declared declared;
    std::string line;
    while (std::getline(stream, line) && !line.starts_with("end_header")) {
        if (const auto stated = originIn(line)) origin = *stated;
        std::istringstream words(line);
        std::string element, kind;
        std::uint64_t count = 0;
        if (!(words >> element >> kind >> count) || element != "element") continue;
        if (kind == "vertex") declared.vertices = count;
        if (kind == "face") declared.faces = count;
    }
    return declared;
}

/// The text without its comment lines, which OpenMesh takes for numbers.
std::string withoutComments(std::istream& stream, glm::dvec3& origin) {
    std::string text, line;
    while (std::getline(stream, line)) {
        if (const auto stated = originIn(line)) origin = *stated;
        if (!line.starts_with('#')) text += line + '\n';
    }
    return text;
}

/// The triangles of a binary .stl, which is recognised by its size: 84 bytes and 50 a triangle. Text may
/// begin with anything, and so may the header of a binary file.
std::optional<std::uint64_t> binaryStlFacets(std::istream& stream, std::uint64_t fileBytes) {
    std::array<unsigned char, 4> count{};
    stream.seekg(kStlHeaderBytes);
    stream.read(reinterpret_cast<char*>(count.data()), count.size());
    if (!stream) return std::nullopt;
    std::uint64_t triangles = 0;
    for (int i = 3; i >= 0; --i) triangles = triangles << 8 | count[static_cast<std::size_t>(i)];
    if (fileBytes != kStlHeaderBytes + 4 + 50 * triangles) return std::nullopt;
    return triangles;
}

/// The triangles of a text .stl.
std::uint64_t textStlFacets(std::istream& stream) {
    std::uint64_t facets = 0;
    for (std::string word; stream >> word;) facets += word == "endfacet";
    return facets;
}

/// Text .stl does not say how long it is, but how it begins and ends.
bool isWholeTextStl(std::istream& stream, std::uint64_t fileBytes) {
    std::string begin(5, '\0');
    std::string end(std::min<std::uint64_t>(fileBytes, 200), '\0');
    stream.read(begin.data(), static_cast<std::streamsize>(begin.size()));
    stream.seekg(-static_cast<std::streamoff>(end.size()), std::ios::end);
    stream.read(end.data(), static_cast<std::streamsize>(end.size()));
    return stream && begin == "solid" && end.find("endsolid") != std::string::npos;
}

void rewind(std::istream& stream) {
    stream.clear();
    stream.seekg(0);
}

/// Runs the reader of OpenMesh. Where `lengthIsDeclared`, a failed read means that the file is damaged:
/// OpenMesh would go on with whatever the variable held.
void parse(std::istream& stream, MeshFormat format, bool lengthIsDeclared, OpenMesh::IO::Options features,
           SurfaceMeshImporter& importer, const std::filesystem::path& file) {
    bool accepted = false;
    try {
        const OpenMeshSession session;
        if (lengthIsDeclared) stream.exceptions(std::ios::failbit | std::ios::badbit);
        accepted = OpenMesh::IO::IOManager().read(stream, extensionOf(format), importer, features);
    } catch (const std::exception&) {
        // Of the stream, or of memory for as much as a damaged file says.
        throw Error("the mesh is damaged or ends early", file.string());
    }
    if (!accepted) throw Error("the mesh is damaged or not of its format", file.string());
    if (importer.brokenFaces() > 0) {
        throw Error(std::to_string(importer.brokenFaces()) + " faces name vertices that do not exist",
                    file.string());
    }
    importer.dropPartialNormals();
}

glm::dvec3 originInFirstBytes(std::istream& stream, std::size_t count) {
    std::string text(count, '\0');
    stream.read(text.data(), static_cast<std::streamsize>(count));
    text.resize(static_cast<std::size_t>(stream.gcount()));
    rewind(stream);
    return originIn(std::string_view(text).substr(0, text.find('\n'))).value_or(glm::dvec3(0));
}

std::ifstream openForReading(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    if (!stream || std::filesystem::is_directory(file)) {
        throw Error(std::string("cannot open the mesh: ") + std::strerror(stream ? EISDIR : errno),
                    file.string());
    }
    stream.imbue(std::locale::classic());
    return stream;
}

void readPly(std::istream& stream, const std::filesystem::path& file, SurfaceMesh& mesh,
             MeshFileLosses& losses) {
    const Declared declared = readPlyHeader(stream, mesh.origin);
    rewind(stream);
    SurfaceMeshImporter importer(mesh);
    parse(stream, MeshFormat::ply, true, OpenMesh::IO::Options::VertexNormal, importer, file);
    losses.polygons = importer.polygons();
    if (declared.vertices != mesh.vertexCount() || declared.faces != importer.n_faces()) {
        throw Error("the mesh is damaged or ends early", file.string());
    }
}

void readOff(std::istream& stream, const std::filesystem::path& file, SurfaceMesh& mesh,
             MeshFileLosses& losses) {
    std::istringstream text(withoutComments(stream, mesh.origin));
    text.imbue(std::locale::classic());
    SurfaceMeshImporter importer(mesh);
    parse(text, MeshFormat::off, true, OpenMesh::IO::Options::VertexNormal, importer, file);
    losses.polygons = importer.polygons();
}

void readObj(std::istream& stream, const std::filesystem::path& file, SurfaceMesh& mesh,
             MeshFileLosses& losses) {
    mesh.origin = originInFirstBytes(stream, kFirstLineBytes);
    SurfaceMeshImporter importer(mesh);
    parse(stream, MeshFormat::obj, false, OpenMesh::IO::Options::VertexNormal, importer, file);
    losses.polygons = importer.polygons();
}

void readStl(std::istream& stream, const std::filesystem::path& file, SurfaceMesh& mesh,
             MeshFileLosses& losses) {
    const std::uint64_t fileBytes = std::filesystem::file_size(file);
    const std::optional<std::uint64_t> facets = binaryStlFacets(stream, fileBytes);
    const bool binary = facets.has_value();
    rewind(stream);
    if (!binary && !isWholeTextStl(stream, fileBytes)) {
        throw Error("the mesh is damaged or ends early", file.string());
    }
    rewind(stream);
    const std::uint64_t declared = binary ? *facets : textStlFacets(stream);
    rewind(stream);
    mesh.origin = originInFirstBytes(stream, binary ? kStlHeaderBytes : kFirstLineBytes);
    SurfaceMeshImporter importer(mesh);
    const auto features = binary ? OpenMesh::IO::Options::Binary : OpenMesh::IO::Options::Default;
    parse(stream, MeshFormat::stl, binary, features, importer, file);
    losses.refused = declared - std::min<std::uint64_t>(declared, importer.n_faces());
}

}  // namespace

SurfaceMesh readMesh(const std::filesystem::path& file, MeshFileLosses* losses) {
    const MeshFormat format = meshFormat(file);
    std::ifstream stream = openForReading(file);
    SurfaceMesh mesh;
    MeshFileLosses read;
    switch (format) {
        case MeshFormat::ply:
            readPly(stream, file, mesh, read);
            break;
        case MeshFormat::obj:
            readObj(stream, file, mesh, read);
            break;
        case MeshFormat::stl:
            readStl(stream, file, mesh, read);
            break;
        case MeshFormat::off:
            readOff(stream, file, mesh, read);
            break;
    }
    if (losses != nullptr) *losses = read;
    return mesh;
}

}  // namespace isoglass
