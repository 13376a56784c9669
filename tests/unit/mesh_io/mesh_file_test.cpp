#include "meshio/mesh_file.h"

#include "base/error.h"
#include "example_meshes.h"
#include "mesh/mesh_check.h"
#include "scratch_folder.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <locale>
#include <tuple>

namespace isoglass {
namespace {

std::string contentsOf(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

/// Positions of the corners of the triangles, in order: all that .stl keeps.
std::vector<glm::vec3> corners(const SurfaceMesh& mesh) {
    std::vector<glm::vec3> result;
    for (const std::uint32_t index : mesh.triangles) result.push_back(mesh.positions[index]);
    return result;
}

using Format = std::tuple<const char*, MeshEncoding>;

class MeshFile : public testing::TestWithParam<Format> {
  protected:
    std::string extension() const { return std::get<0>(GetParam()); }
    std::filesystem::path file() const { return folder_ / ("mesh." + extension()); }
    SurfaceMesh roundTrip(const SurfaceMesh& mesh) const {
        writeMesh(file(), mesh, {.encoding = std::get<1>(GetParam())});
        return readMesh(file());
    }
    bool sharesVertices() const { return extension() != "stl"; }

    ScratchFolder folder_;
};

TEST_P(MeshFile, RoundTripKeepsPositionsWindingAndOrigin) {
    for (const SurfaceMesh& mesh : {makeTetrahedron(), makeTorus(50, 40)}) {
        const SurfaceMesh read = roundTrip(mesh);
        EXPECT_EQ(corners(read), corners(mesh));
        EXPECT_EQ(read.origin, mesh.origin);
        EXPECT_EQ(read.vertexCount(), mesh.vertexCount());
        if (sharesVertices()) {
            EXPECT_EQ(read.positions, mesh.positions);
            EXPECT_EQ(read.triangles, mesh.triangles);
        }
    }
}

TEST_P(MeshFile, OriginIsStatedToTheLastBit) {
    SurfaceMesh mesh = makeTetrahedron();
    mesh.origin = {-1.0 / 3e5, 0.1, 6378137.123456789};
    EXPECT_EQ(roundTrip(mesh).origin, mesh.origin);
    EXPECT_NE(contentsOf(file()).find("origin -3.3333333333333333e-06 0.1 6378137.123456789"),
              std::string::npos);
    mesh.origin = glm::dvec3(0);
    roundTrip(mesh);
    EXPECT_NE(contentsOf(file()).find("origin 0 0 0"), std::string::npos);
}

TEST_P(MeshFile, ZeroAreaTrianglesStay) {
    SurfaceMesh mesh = makeTetrahedron();
    mesh.positions.push_back({0.6f, 0, 0});  // on the edge 0-1
    mesh.normals.push_back({0, 1, 0});
    mesh.triangles.insert(mesh.triangles.end(), {0, 1, 4});
    EXPECT_EQ(corners(roundTrip(mesh)), corners(mesh));
}

TEST_P(MeshFile, NonManifoldTrianglesStay) {
    SurfaceMesh mesh = makeTetrahedron();
    append(mesh, makeTetrahedron(), {5, 0, 0});
    for (std::uint32_t& index : mesh.triangles) index = index == 4 ? 0 : index;
    mesh.triangles.insert(mesh.triangles.end(), {0, 1, 7});
    ASSERT_EQ(checkTopology(mesh).nonManifoldEdges, 2u);  // 0-1 and 0-7
    ASSERT_GT(checkTopology(mesh).nonManifoldVertices, 0u);
    EXPECT_EQ(corners(roundTrip(mesh)), corners(mesh));
}

TEST_P(MeshFile, EmptyMeshIsAValidFile) {
    const SurfaceMesh read = roundTrip(SurfaceMesh{});
    EXPECT_EQ(read.vertexCount(), 0u);
    EXPECT_EQ(read.triangleCount(), 0u);
}

TEST_P(MeshFile, MeshWithoutNormalsIsWritten) {
    SurfaceMesh mesh = makeTetrahedron();
    mesh.normals.clear();
    const SurfaceMesh read = roundTrip(mesh);
    EXPECT_EQ(corners(read), corners(mesh));
    EXPECT_TRUE(read.normals.empty());
}

TEST_P(MeshFile, ExtremePositionsSurvive) {
    SurfaceMesh mesh = makeTetrahedron();
    mesh.positions = {
        {1e-30f, -3.4e38f, 16777217.0f}, {1 / 3.0f, 0, -0.0f}, {1e10f, 2e-10f, 7}, {-1, -2, -3}};
    EXPECT_EQ(corners(roundTrip(mesh)), corners(mesh));
}

TEST_P(MeshFile, DecimalCommaOfTheUserDoesNotReachTheFile) {
    struct DecimalComma : std::numpunct<char> {
        char do_decimal_point() const override { return ','; }
        char do_thousands_sep() const override { return '.'; }
        std::string do_grouping() const override { return "\3"; }
    };
    const SurfaceMesh mesh = makeTorus(50, 40);
    const std::locale before = std::locale::global(std::locale(std::locale::classic(), new DecimalComma));
    writeMesh(file(), mesh, {.encoding = std::get<1>(GetParam())});
    std::locale::global(before);
    EXPECT_EQ(corners(readMesh(file())), corners(mesh));
}

TEST_P(MeshFile, FileThatEndsEarlyIsRefused) {
    if (extension() == "obj") GTEST_SKIP() << ".obj does not say how long it is";
    const SurfaceMesh mesh = makeTorus(6, 5);
    roundTrip(mesh);
    // 60 bytes are more than the comment at the end of .off, so that a face is cut as well.
    const std::uintmax_t whole = std::filesystem::file_size(file());
    for (const std::uintmax_t length : {whole - 60, whole / 2, whole / 3}) {
        roundTrip(mesh);
        std::filesystem::resize_file(file(), length);
        EXPECT_THROW(readMesh(file()), Error) << length << " of " << whole;
    }
}

INSTANTIATE_TEST_SUITE_P(Formats, MeshFile,
                         testing::Values(Format{"ply", MeshEncoding::binary},
                                         Format{"ply", MeshEncoding::text},
                                         Format{"stl", MeshEncoding::binary},
                                         Format{"stl", MeshEncoding::text}, Format{"obj", MeshEncoding::text},
                                         Format{"off", MeshEncoding::text}),
                         [](const auto& format) {
                             return std::string(std::get<0>(format.param)) +
                                    (std::get<1>(format.param) == MeshEncoding::binary ? "Binary" : "Text");
                         });

TEST(MeshFileNormals, AreWrittenWithLengthOne) {
    const ScratchFolder folder;
    for (const char* name : {"mesh.ply", "mesh.obj"}) {
        writeMesh(folder / name, makeTetrahedron());
        const SurfaceMesh read = readMesh(folder / name);
        ASSERT_EQ(read.normals.size(), 4u) << name;
        // Three components, each rounded to single precision.
        EXPECT_LT(glm::length(read.normals[0] - glm::vec3(-std::sqrt(1 / 3.0f))), 3 * 6e-8f) << name;
        EXPECT_EQ(read.normals[1], glm::vec3(1, 0, 0)) << name;
        EXPECT_EQ(read.normals[2], glm::vec3(0, 1, 0)) << name;
        EXPECT_EQ(read.normals[3], glm::vec3(0, 0, 1)) << name;
    }
}

TEST(MeshFileNormals, OffHasThemBesideThePositions) {
    const ScratchFolder folder;
    writeMesh(folder / "mesh.off", makeTetrahedron());
    const std::string text = contentsOf(folder / "mesh.off");
    EXPECT_EQ(text.substr(0, 5), "NOFF\n");
    EXPECT_NE(text.find("\n1.10000002 0 0 1 0 0\n"), std::string::npos) << text;
}

TEST(MeshFileNormals, StlHasThoseOfTheFacets) {
    const ScratchFolder folder;
    SurfaceMesh mesh = makeTetrahedron();
    mesh.positions[0].x = 0;
    mesh.positions[1].x = 1e-25f;  // tiny, but not zero: the square underflows in single precision
    mesh.positions[2] = {0, 1e-25f, 0};
    mesh.triangles = {0, 1, 2, 0, 1, 1};
    writeMesh(folder / "mesh.stl", mesh, {.encoding = MeshEncoding::text});
    const std::string text = contentsOf(folder / "mesh.stl");
    EXPECT_NE(text.find("facet normal 0 0 1\n"), std::string::npos) << text;
    EXPECT_NE(text.find("facet normal 0 0 0\n"), std::string::npos) << text;
}

TEST(MeshFileReader, PolygonsBecomeFansAndForeignCommentsAreSkipped) {
    const ScratchFolder folder;
    std::ofstream(folder / "quad.off")
        << "OFF\n# made elsewhere\n4 1 0\n0 0 0\n1 0 0\n# a corner\n1 1 0\n0 1 0\n4 0 1 2 3\n";
    const SurfaceMesh mesh = readMesh(folder / "quad.off");
    EXPECT_EQ(mesh.triangles, (std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3}));
    EXPECT_EQ(mesh.origin, glm::dvec3(0));
}

TEST(MeshFileReader, SplitAndRefusedFacesAreCounted) {
    const ScratchFolder folder;
    std::ofstream(folder / "mixed.obj")
        << "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 2 0\nf 1 2 3 4\nf 1 2 3\nf 1 2 3 4 5\n";
    MeshFileLosses losses;
    EXPECT_EQ(readMesh(folder / "mixed.obj", &losses).triangleCount(), 6u);
    EXPECT_EQ(losses.polygons, 2u);
    EXPECT_EQ(losses.refused, 0u);
    SurfaceMesh mesh = makeTetrahedron();
    mesh.triangles.insert(mesh.triangles.end(), {0, 0, 1});
    for (const MeshEncoding encoding : {MeshEncoding::binary, MeshEncoding::text}) {
        writeMesh(folder / "flat.stl", mesh, {.encoding = encoding});
        EXPECT_EQ(readMesh(folder / "flat.stl", &losses).triangleCount(), 4u);
        EXPECT_EQ(losses.polygons, 0u);
        EXPECT_EQ(losses.refused, 1u);
    }
}

/// As modellers write a box: a vertex has the normals of three faces, of which none is its own.
TEST(MeshFileReader, NormalsOfCornersThatDifferAreLeftOut) {
    const ScratchFolder folder;
    const std::string corner = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvn 0 0 -1\nvn 0 -1 0\nvn -1 0 0\n";
    std::ofstream(folder / "sharp.obj") << corner << "f 1//1 3//1 2//1\nf 1//2 2//2 4//2\nf 1//3 4//3 3//3\n";
    EXPECT_TRUE(readMesh(folder / "sharp.obj").normals.empty());
    std::ofstream(folder / "smooth.obj") << corner << "f 1//1 3//1 2//1\nf 1//1 2//1 4//1\n";
    EXPECT_EQ(readMesh(folder / "smooth.obj").normals.size(), 4u);
}

TEST(MeshFileReader, FacesWithoutVerticesAreRefused) {
    const ScratchFolder folder;
    std::ofstream(folder / "bad.off") << "OFF\n3 1 0\n0 0 0\n1 0 0\n1 1 0\n3 0 1 7\n";
    EXPECT_THROW(readMesh(folder / "bad.off"), Error);
}

}  // namespace
}  // namespace isoglass
