#include "app/app_test.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <sstream>

namespace isoglass::test {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kSide = 49;

/// Fields of a line; none of ours has a comma inside quotes but in the header.
std::vector<std::string> split(const std::string& line) {
    std::vector<std::string> fields;
    std::istringstream stream(line);
    for (std::string text; std::getline(stream, text, ',');) fields.push_back(text);
    return fields;
}

class MeshSeries : public AppTest {
  protected:
    /// Rows of the table, by name of the column without its units.
    std::vector<std::map<std::string, double>> table(const std::string& name) const {
        std::istringstream lines(bytesOf(name));
        std::string line;
        std::getline(lines, line);
        std::vector<std::string> names = split(line);
        for (std::string& column : names) column = column.substr(0, column.find(' '));
        std::vector<std::map<std::string, double>> rows;
        while (std::getline(lines, line)) {
            const std::vector<std::string> fields = split(line);
            EXPECT_EQ(fields.size(), names.size()) << line;
            for (std::size_t i = 0; i < fields.size(); ++i) {
                if (i == 0) rows.emplace_back();
                rows.back()[names[i]] = names[i] == "date" ? 0 : std::stod(fields[i]);
            }
        }
        return rows;
    }

    /// A PVM file of 8-bit samples: 128 on the surface, falling by 8 a voxel outwards.
    template <typename Distance>
    void writeShape(const std::string& name, Distance outside) const {
        std::ofstream file(folder_ / name, std::ios::binary);
        file << "PVM\n" << kSide << ' ' << kSide << ' ' << kSide << "\n1\n";
        for (int z = 0; z < kSide; ++z) {
            for (int y = 0; y < kSide; ++y) {
                for (int x = 0; x < kSide; ++x) {
                    const double c = (kSide - 1) / 2.0;
                    const double value = 128 - 8 * outside(x - c, y - c, z - c);
                    file.put(static_cast<char>(std::lround(std::clamp(value, 0.0, 255.0))));
                }
            }
        }
    }

    void writeSphere(const std::string& name, double radius) const {
        writeShape(name, [&](double x, double y, double z) { return std::hypot(x, y, z) - radius; });
    }
};

/// Samples are rounded to 1/16 of a voxel. Interpolation moves the surface by 3/8 / (r - 2) voxels (see
/// EnclosedVolume), and so does the mesh's coarser form; a mesh whose facets tilt by up to an angle of
/// 1/r has an area that is off by that angle squared.
double displacement(double radius) {
    return 1.0 / 16 + 2 * 3.0 / 8 / (radius - 2);
}

TEST_F(MeshSeries, SpheresHaveTheFiguresOfSpheres) {
    const std::vector<double> radii = {10, 14, 18};
    std::vector<std::string> arguments = {"import"};
    for (std::size_t i = 0; i < radii.size(); ++i) {
        arguments.push_back(std::to_string(i) + ".pvm");
        writeSphere(arguments.back(), radii[i]);
    }
    arguments.insert(arguments.end(), {"-o", "spheres.vdb", "--times", "2,3,5"});
    run(arguments);
    const RunResult result = run({"mesh", "spheres.vdb", "--iso", "128", "--series", "-o", "spheres.csv"});
    EXPECT_EQ(result.out, "spheres.csv: 3 moments\n");
    EXPECT_TRUE(contains(result.err, "measuring 3/3 moments")) << result.err;
    const auto rows = table("spheres.csv");
    ASSERT_EQ(rows.size(), 3u);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const double r = radii[i];
        const double d = displacement(r);
        EXPECT_EQ(rows[i].at("time"), (std::vector<double>{2, 3, 5})[i]);
        EXPECT_NEAR(rows[i].at("area"), 4 * kPi * r * r, 4 * kPi * r * r * (2 * d / r + 1 / (r * r))) << r;
        EXPECT_NEAR(rows[i].at("volume"), 4 * kPi / 3 * r * r * r,
                    4 * kPi / 3 * (std::pow(r + d, 3) - r * r * r))
            << r;
        EXPECT_NEAR(rows[i].at("volume_share"), rows[i].at("volume") / std::pow(kSide - 1, 3), 1e-12);
        EXPECT_EQ(rows[i].at("components"), 1);
        EXPECT_EQ(rows[i].at("euler_number"), 2);
        EXPECT_EQ(rows[i].at("boundary_edges"), 0);
        EXPECT_EQ(rows[i].at("missing_cells"), 0);
    }
}

TEST_F(MeshSeries, ATorusHasTheFiguresOfATorus) {
    constexpr double kRing = 14, kTube = 7;
    writeShape("torus.pvm",
               [](double x, double y, double z) { return std::hypot(std::hypot(x, y) - kRing, z) - kTube; });
    run({"import", "torus.pvm", "-o", "torus.vdb"});
    run({"mesh", "torus.vdb", "--iso", "128", "--series", "-o", "torus.csv"});
    const auto rows = table("torus.csv");
    ASSERT_EQ(rows.size(), 1u);
    const double d = displacement(kTube);
    EXPECT_NEAR(rows[0].at("area"), 4 * kPi * kPi * kRing * kTube,
                4 * kPi * kPi * kRing * kTube * (2 * d / kTube + 1 / (kTube * kTube)));
    EXPECT_NEAR(rows[0].at("volume"), 2 * kPi * kPi * kRing * kTube * kTube,
                2 * kPi * kPi * kRing * (std::pow(kTube + d, 2) - kTube * kTube));
    EXPECT_EQ(rows[0].at("components"), 1);
    EXPECT_EQ(rows[0].at("euler_number"), 0);
}

/// A ball that reaches out of the domain on one side: half of it is inside, its surface is open, and the
/// volume is closed by the domain's end.
TEST_F(MeshSeries, AnOpenSurfaceEnclosesVolumeUpToTheDomainsEnd) {
    constexpr double kRadius = 15, kHalf = (kSide - 1) / 2.0;
    writeShape("half.pvm",
               [&](double x, double y, double z) { return std::hypot(x + kHalf, y, z) - kRadius; });
    run({"import", "half.pvm", "-o", "half.vdb"});
    run({"mesh", "half.vdb", "--iso", "128", "--series", "-o", "half.csv"});
    const auto rows = table("half.csv");
    const double d = displacement(kRadius);
    EXPECT_NEAR(rows[0].at("volume"), 2 * kPi / 3 * std::pow(kRadius, 3),
                2 * kPi / 3 * (std::pow(kRadius + d, 3) - std::pow(kRadius, 3)));
    EXPECT_EQ(rows[0].at("euler_number"), 1) << "a disk";
    EXPECT_GT(rows[0].at("boundary_edges"), 0);
}

TEST_F(MeshSeries, StepsMeasureBetweenKeyFrames) {
    writeSphere("0.pvm", 8);
    writeSphere("1.pvm", 16);
    run({"import", "0.pvm", "1.pvm", "-o", "two.vdb", "--times", "0,8"});
    run({"mesh", "two.vdb", "--iso", "128", "--series", "--steps", "4", "-o", "two.csv"});
    const auto rows = table("two.csv");
    ASSERT_EQ(rows.size(), 5u);
    for (std::size_t i = 1; i < rows.size(); ++i) {
        EXPECT_EQ(rows[i].at("time"), 2.0 * static_cast<double>(i));
        EXPECT_GT(rows[i].at("volume"), rows[i - 1].at("volume"));
    }
}

TEST_F(MeshSeries, TwoPiecesAndNoneAreCounted) {
    writeShape("step1.pvm", [](double x, double y, double z) {
        return std::min(std::hypot(x - 12, y, z), std::hypot(x + 12, y, z)) - 7;
    });
    writeShape("step2.pvm", [](double, double, double) { return 10.0; });
    run({"import", "step1.pvm", "step2.pvm", "-o", "pieces.vdb"});
    run({"mesh", "pieces.vdb", "--iso", "128", "--series", "-o", "pieces.csv"});
    const auto rows = table("pieces.csv");
    EXPECT_EQ(rows[0].at("components"), 2);
    EXPECT_EQ(rows[0].at("euler_number"), 4);
    for (const char* column : {"area", "volume", "components", "euler_number", "triangles"})
        EXPECT_EQ(rows[1].at(column), 0) << column;
}

TEST_F(MeshSeries, TheOceanHasDatesUnitsAndMissingCells) {
    importOcean();
    const RunResult result = run({"mesh", "ocean.vdb", "--iso", "20", "--series", "-o", "ocean.csv"});
    EXPECT_TRUE(contains(result.err, "different units")) << result.err;
    const std::string text = bytesOf("ocean.csv");
    EXPECT_TRUE(contains(text, "since 0000-01-01")) << text;
    EXPECT_TRUE(contains(text, ",date,")) << text;
    EXPECT_TRUE(contains(text, "\n366,0000-01-16T06:00:00,")) << text;
    EXPECT_TRUE(contains(text, "\"volume [units of the axes: ")) << text;
}

TEST_F(MeshSeries, DoesNotDependOnThreads) {
    importOcean();
    run({"mesh", "ocean.vdb", "--iso", "20", "--series", "-o", "one.csv", "--threads", "1"});
    run({"mesh", "ocean.vdb", "--iso", "20", "--series", "-o", "two.csv", "--threads", "3"});
    EXPECT_EQ(bytesOf("one.csv"), bytesOf("two.csv"));
}

}  // namespace
}  // namespace isoglass::test
