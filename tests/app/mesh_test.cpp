#include "app/app_test.h"

#include <cmath>
#include <cstring>
#include <fstream>
#include <regex>

namespace isoglass::test {
namespace {

class Mesh : public AppTest {
  protected:
    void SetUp() override { importOcean(); }
};

/// The number before `word` in a text such as "5 vertices, 6 triangles".
std::size_t numberBefore(const std::string& text, const std::string& word) {
    std::smatch match;
    return std::regex_search(text, match, std::regex("([0-9]+) " + word)) ? std::stoul(match[1]) : 0;
}

TEST_F(Mesh, WritesEveryFormat) {
    std::size_t vertices = 0, triangles = 0;
    for (const std::string extension : {"ply", "obj", "stl", "off"}) {
        const std::string name = "mesh." + extension;
        const RunResult result = run({"mesh", "ocean.vdb", "--iso", "15", "-o", name});
        EXPECT_TRUE(contains(result.out, name + ": ")) << result.out;
        vertices = numberBefore(result.out, "vertices");
        triangles = numberBefore(result.out, "triangles");
        EXPECT_GT(vertices, 1000u);
        EXPECT_GT(triangles, 1000u);
    }
    EXPECT_TRUE(bytesOf("mesh.ply").starts_with("ply\n"));
    EXPECT_TRUE(contains(bytesOf("mesh.ply"), "element vertex " + std::to_string(vertices)));
    EXPECT_TRUE(contains(bytesOf("mesh.ply"), "element face " + std::to_string(triangles)));
    EXPECT_TRUE(contains(bytesOf("mesh.obj"), "\nf "));
    // Binary STL: 80 bytes of header, the count, 50 bytes a triangle.
    const std::string stl = bytesOf("mesh.stl");
    ASSERT_EQ(stl.size(), 84 + 50 * triangles);
    std::uint32_t count = 0;
    std::memcpy(&count, stl.data() + 80, sizeof count);
    EXPECT_EQ(count, triangles);
    EXPECT_TRUE(contains(bytesOf("mesh.off").substr(0, 8), "OFF"));
}

TEST_F(Mesh, DoesNotDependOnThreads) {
    run({"mesh", "ocean.vdb", "--iso", "15", "-o", "one.ply", "--threads", "1"});
    run({"mesh", "ocean.vdb", "--iso", "15", "-o", "two.ply", "--threads", "2"});
    EXPECT_EQ(bytesOf("one.ply"), bytesOf("two.ply"));
}

TEST_F(Mesh, TimeChoosesTheMoment) {
    // Hours of the climatology, between its first and its second month.
    run({"mesh", "ocean.vdb", "--iso", "15", "-o", "first.ply"});
    run({"mesh", "ocean.vdb", "--iso", "15", "--time", "700", "-o", "later.ply"});
    EXPECT_NE(bytesOf("first.ply"), bytesOf("later.ply"));
}

TEST_F(Mesh, ViewMakesItCoarserWithTheDistance) {
    // A ball of bytes: 255 in the middle, 3 less a sample outwards.
    constexpr int kSide = 64;
    std::string bytes = "PVM\n64 64 64\n1\n";
    for (int i = 0; i < kSide * kSide * kSide; ++i) {
        const double x = i % kSide - 31.5, y = i / kSide % kSide - 31.5, z = i / (kSide * kSide) - 31.5;
        bytes += static_cast<char>(255 - static_cast<int>(3 * std::sqrt(x * x + y * y + z * z)));
    }
    std::ofstream(folder_ / "ball.pvm", std::ios::binary) << bytes;
    run({"import", "ball.pvm", "-o", "ball.vdb"});
    const auto triangles = [&](const std::string& eye) {
        const RunResult result = run({"mesh", "ball.vdb", "--iso", "180", "-o", "view.ply", "--eye", eye,
                                      "--pixels", "20", "--size", "1280x720"});
        return numberBefore(result.out, "triangles");
    };
    // A cell is 20 pixels at a distance of 67 cells: level 1 from 134 on, level 2, of sixteen times fewer
    // triangles of which half are tetrahedral, from 269 on.
    const std::size_t near = triangles("32,32,64");
    EXPECT_GT(near, 5000u);
    EXPECT_LT(2 * triangles("32,32,220"), near);
    EXPECT_LT(5 * triangles("32,32,500"), near);
    // Values are rounded to whole numbers, three a sample: the surface is rough by a sixth of a cell, which
    // takes 7 pixels seen from near by, and 0.08 from 3000 cells away.
    const auto byError = [&](const std::string& eye) {
        const RunResult result = run({"mesh", "ball.vdb", "--iso", "180", "-o", "view.ply", "--eye", eye,
                                      "--error-pixels", "0.5", "--size", "1280x720"});
        return numberBefore(result.out, "triangles");
    };
    EXPECT_GT(byError("32,32,64"), 5000u);
    EXPECT_LT(5 * byError("32,32,3000"), near);
}

TEST_F(Mesh, ViewIsGivenWhole) {
    for (const std::vector<std::string>& part :
         {std::vector<std::string>{"--eye", "1,2,3"},
          {"--pixels", "1"},
          {"--error-pixels", "1"},
          {"--fov", "40"},
          {"--eye", "1,2,3", "--size", "64x64"},
          {"--eye", "1,2,3", "--size", "64x64", "--pixels", "1", "--error-pixels", "1"}}) {
        std::vector<std::string> arguments = {"mesh", "ocean.vdb", "--iso", "15", "-o", "view.ply"};
        arguments.insert(arguments.end(), part.begin(), part.end());
        EXPECT_EQ(isoglass(arguments).status, 2) << part[0];
    }
    EXPECT_EQ(isoglass({"mesh", "ocean.vdb", "--iso", "15", "-o", "view.ply", "--eye", "1,2", "--pixels", "1",
                        "--size", "64x64"})
                  .status,
              2);
}

TEST_F(Mesh, EmptySurfaceIsWrittenAndSaid) {
    const RunResult result = run({"mesh", "ocean.vdb", "--iso", "1000", "-o", "empty.ply"});
    EXPECT_TRUE(contains(result.err, "isoglass: note: the mesh is empty: iso-value 1000")) << result.err;
    EXPECT_TRUE(contains(result.out, "0 vertices, 0 triangles")) << result.out;
    EXPECT_TRUE(contains(bytesOf("empty.ply"), "element face 0"));
}

/// Two PVM key frames at times 0 and 1: a series that does not repeat.
TEST_F(Mesh, TimeOutsideTheSeriesIsSaidAndShowsTheNearestKeyFrame) {
    for (const char* name : {"a.pvm", "b.pvm"}) {
        std::ofstream file(folder_ / name, std::ios::binary);
        file << "PVM\n3 3 3\n1\n";
        for (int i = 0; i < 27; ++i) file.put(static_cast<char>(i == 13 ? (name[0] == 'a' ? 200 : 100) : 0));
    }
    run({"import", "a.pvm", "b.pvm", "-o", "pvm.vdb"});
    run({"mesh", "pvm.vdb", "--iso", "50", "--time", "1", "-o", "last.ply"});
    const RunResult result = run({"mesh", "pvm.vdb", "--iso", "50", "--time", "7.5", "-o", "outside.ply"});
    EXPECT_TRUE(contains(result.err, "time 7.5 lies outside the series")) << result.err;
    EXPECT_EQ(bytesOf("outside.ply"), bytesOf("last.ply"));
}

}  // namespace
}  // namespace isoglass::test
