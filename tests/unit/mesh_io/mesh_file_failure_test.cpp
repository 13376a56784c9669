#include "base/error.h"
#include "example_meshes.h"
#include "meshio/mesh_file.h"
#include "scratch_folder.h"
#include "support/file_size_limit.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>
#include <limits>
#include <sstream>

namespace isoglass {
namespace {

std::string messageOf(const std::filesystem::path& file, const SurfaceMesh& mesh) {
    try {
        writeMesh(file, mesh);
    } catch (const Error& error) {
        return error.what();
    }
    return "no error";
}

TEST(MeshFileFailure, FullDiskIsReportedAndLeavesTheOlderFile) {
    const SurfaceMesh mesh = makeTorus(200, 100);
    for (const char* extension : {"ply", "obj", "stl", "off"}) {
        // The first bytes, the middle, and (with one block alone) the last write before closing.
        for (const rlim_t bytes : {rlim_t{0}, rlim_t{1000}, rlim_t{300'000}}) {
            const ScratchFolder folder;
            const std::filesystem::path file = folder / (std::string("mesh.") + extension);
            std::ofstream(file) << "older";
            std::string message;
            {
                const FileSizeLimit limit(bytes);
                message = messageOf(file, mesh);
            }
            EXPECT_NE(message.find(file.string()), std::string::npos) << message;
            EXPECT_NE(message.find("File too large"), std::string::npos) << message;
            EXPECT_EQ(folder.fileCount(), 1u) << file;
            std::ostringstream contents;
            contents << std::ifstream(file).rdbuf();
            EXPECT_EQ(contents.str(), "older");
        }
    }
}

TEST(MeshFileFailure, SmallFileOnAFullDiskIsReported) {
    const ScratchFolder folder;
    const FileSizeLimit limit(10);
    EXPECT_NE(messageOf(folder / "mesh.ply", makeTetrahedron()).find("File too large"), std::string::npos);
    EXPECT_EQ(folder.fileCount(), 0u);
}

TEST(MeshFileFailure, MissingFolderIsNamed) {
    const std::string message = messageOf("/nowhere/at/all/mesh.ply", makeTetrahedron());
    EXPECT_NE(message.find("(/nowhere/at/all"), std::string::npos) << message;
}

TEST(MeshFileFailure, FolderThatCannotBeWrittenIsReported) {
    if (::geteuid() == 0) GTEST_SKIP() << "the superuser may write anywhere";
    const ScratchFolder folder;
    ::chmod(folder.path().c_str(), 0500);
    EXPECT_NE(messageOf(folder / "mesh.ply", makeTetrahedron()).find("Permission denied"), std::string::npos);
    ::chmod(folder.path().c_str(), 0700);
}

TEST(MeshFileFailure, UnknownExtensionListsTheKnownOnes) {
    const ScratchFolder folder;
    for (const char* name : {"mesh.fbx", "mesh", "mesh.", ".ply"}) {
        const std::string message = messageOf(folder / name, makeTetrahedron());
        EXPECT_NE(message.find("use .ply, .obj, .stl or .off"), std::string::npos) << message;
        EXPECT_EQ(folder.fileCount(), 0u);
    }
    EXPECT_THROW(readMesh(folder / "mesh.fbx"), Error);
}

TEST(MeshFileFailure, ExtensionsMayBeCapital) {
    const ScratchFolder folder;
    writeMesh(folder / "MESH.PLY", makeTetrahedron());
    EXPECT_EQ(readMesh(folder / "MESH.PLY").triangleCount(), 4u);
}

TEST(MeshFileFailure, OriginTooLongForAStlHeaderIsRefused) {
    const ScratchFolder folder;
    SurfaceMesh mesh = makeTetrahedron();
    mesh.origin = glm::dvec3(-2.2250738585072014e-308);  // the longest numeral: 24 letters
    EXPECT_NE(messageOf(folder / "mesh.stl", mesh).find("header"), std::string::npos);
    EXPECT_EQ(folder.fileCount(), 0u);
    writeMesh(folder / "mesh.stl", mesh, {.encoding = MeshEncoding::text});
    EXPECT_EQ(readMesh(folder / "mesh.stl").origin, mesh.origin);
}

TEST(MeshFileFailure, MissingFileIsNamed) {
    const ScratchFolder folder;
    try {
        readMesh(folder / "mesh.ply");
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_EQ(error.where(), (folder / "mesh.ply").string());
    }
}

TEST(MeshFileFailure, RubbishIsRefused) {
    const ScratchFolder folder;
    for (const char* name : {"mesh.ply", "mesh.off", "mesh.stl"}) {
        std::ofstream(folder / name) << "This is not a mesh.\nNot at all.\n";
        EXPECT_THROW(readMesh(folder / name), Error) << name;
    }
}

}  // namespace
}  // namespace isoglass
