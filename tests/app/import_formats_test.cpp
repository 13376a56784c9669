#include "app/app_test.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <cstring>

namespace isoglass::test {
namespace {

using Json = nlohmann::json;

class ImportFormats : public AppTest {
  protected:
    Json info(const std::string& series) const {
        return Json::parse(run({"info", series, "--json"}).out).at("series").at(0);
    }

    /// NRRD of 2 x 3 x 4 bytes, each `value` but for the first.
    void writeNrrd(const std::string& name, char value) const {
        std::ofstream(folder_ / name, std::ios::binary)
            << "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 2 3 4\nencoding: raw\n\n"
            << std::string(1, '\0') << std::string(23, value);
    }
};

TEST_F(ImportFormats, HelpListsThem) {
    const std::string help = run({"import", "--help"}).out;
    for (const char* format :
         {"NetCDF", "PVM", ".vti", ".pvd", ".nii.gz", ".nrrd", ".mha", ".slc", ".vdb", "RAW"})
        EXPECT_TRUE(contains(help, format)) << format;
}

TEST_F(ImportFormats, UnknownFormatSaysWhereTheListIs) {
    std::ofstream(folder_ / "a.xyz") << "what is this";
    const RunResult result = isoglass({"import", "a.xyz", "-o", "a.vdb"});
    EXPECT_EQ(result.status, 1);
    EXPECT_TRUE(contains(result.err, "not known (a.xyz)") && contains(result.err, "import --help"))
        << result.err;
}

TEST_F(ImportFormats, WithoutVtkItsFilesAreRefusedWithTheWayOut) {
    if (ISOGLASS_VTK) GTEST_SKIP() << "built with VTK";
    EXPECT_TRUE(contains(run({"import", "--help"}).out, "not in this build")) << "the list says so";
    std::ofstream(folder_ / "a.vti") << R"(<VTKFile type="ImageData"><ImageData/></VTKFile>)";
    const RunResult result = isoglass({"import", "a.vti", "-o", "a.vdb"});
    EXPECT_EQ(result.status, 1);
    EXPECT_TRUE(contains(result.err, "this build cannot read VTK image data (a.vti); install libvtk9-dev"))
        << result.err;
    EXPECT_EQ(files(), (std::set<std::string>{"a.vti"}));
}

TEST_F(ImportFormats, ContentComesBeforeTheName) {
    writeNrrd("a.nii", 7);
    run({"import", "a.nii", "-o", "a.vdb"});
    EXPECT_EQ(info("a.vdb").at("range"), Json({0, 7}));
}

TEST_F(ImportFormats, FilesAreOrderedByTheNumbersInTheirNames) {
    for (const int i : {1, 2, 10}) writeNrrd("t" + std::to_string(i) + ".nrrd", static_cast<char>(i));
    const RunResult result = run({"import", "t1.nrrd", "t10.nrrd", "t2.nrrd", "-o", "sorted.vdb"});
    EXPECT_TRUE(contains(result.err, "in the order of their names: t1.nrrd to t10.nrrd")) << result.err;
    run({"import", "t1.nrrd", "t2.nrrd", "t10.nrrd", "-o", "ordered.vdb"});
    EXPECT_EQ(bytesOf("sorted.vdb"), bytesOf("ordered.vdb"));
    // Times of the command line belong to the files as they are named there.
    run({"import", "t10.nrrd", "t1.nrrd", "--times", "3,5", "-o", "timed.vdb"});
    EXPECT_EQ(info("timed.vdb").at("times"), Json({3, 5}));
    run({"export", "timed.vdb", "-o", "timed.json"});
    const std::string bytes = bytesOf("timed.raw");
    ASSERT_EQ(bytes.size(), 2u * 24 * 4);
    float second = 0;
    std::memcpy(&second, bytes.data() + 4, 4);
    EXPECT_EQ(second, 10);
}

TEST_F(ImportFormats, TimesMayComeFromTheNames) {
    for (const int i : {1, 2, 10}) writeNrrd("t" + std::to_string(i) + ".nrrd", static_cast<char>(i));
    run({"import", "t10.nrrd", "t2.nrrd", "t1.nrrd", "--time-from-name", "-o", "a.vdb"});
    EXPECT_EQ(info("a.vdb").at("times"), Json({1, 2, 10}));
    writeNrrd("a.nrrd", 1);
    const RunResult none = isoglass({"import", "a.nrrd", "--time-from-name", "-o", "b.vdb"});
    EXPECT_EQ(none.status, 1);
    EXPECT_TRUE(contains(none.err, "no number in the name (a.nrrd)")) << none.err;
    EXPECT_EQ(isoglass({"import", "t1.nrrd", "--time-from-name", "--times", "1", "-o", "b.vdb"}).status, 2);
    writeNrrd("t01.nrrd", 1);
    const RunResult twice =
        isoglass({"import", "t1.nrrd", "t01.nrrd", "t2.nrrd", "--time-from-name", "-o", "b.vdb"});
    EXPECT_EQ(twice.status, 1);
    EXPECT_TRUE(contains(twice.err, "strictly increase")) << twice.err;
}

TEST_F(ImportFormats, ExportOfTheOceanComesBack) {
    importOcean();
    run({"export", "ocean.vdb", "-o", "ocean.json"});
    run({"import", "ocean.json", "-o", "again.vdb"});
    Json first = info("ocean.vdb"), second = info("again.vdb");
    for (const char* key : {"file", "bytes_file", "provenance", "notes"}) {
        first.erase(key);
        second.erase(key);
    }
    EXPECT_EQ(first, second);
    run({"export", "again.vdb", "-o", "again.json"});
    EXPECT_EQ(bytesOf("again.raw"), bytesOf("ocean.raw"));
    EXPECT_EQ(bytesOf("again.raw").size(), 36u * 23 * 19 * 12 * 4);
}

TEST_F(ImportFormats, ExportNeedsTheExtensionAndAFolder) {
    importOcean();
    const auto before = files();
    for (const char* out : {"ocean.raw", "no/ocean.json"}) {
        const RunResult result = isoglass({"export", "ocean.vdb", "-o", out});
        EXPECT_EQ(result.status, 1);
        EXPECT_TRUE(contains(result.err, "no") || contains(result.err, out)) << result.err;
    }
    EXPECT_EQ(isoglass({"export", "ocean.vdb", "-o", "out.json"}, {.fileSizeLimit = 5000}).status, 1);
    EXPECT_EQ(files(), before);
}

/// What data/README.md of the data says.
struct RealSeries {
    const char* folder;
    const char* pattern;  ///< start of the files' names
    std::vector<std::string> options;
    std::array<int, 3> dims;
    std::size_t steps;
    std::array<double, 3> spacing;
    std::array<double, 2> range;
    bool needsVtk = false;
};

class RealFormats : public ImportFormats, public testing::WithParamInterface<RealSeries> {
  protected:
    static std::filesystem::path data() {
        const char* folder = std::getenv("ISOGLASS_DATA");
        return folder ? folder : "";
    }
    std::vector<std::string> filesOf(const RealSeries& series) const {
        std::vector<std::string> names;
        for (const auto& entry : std::filesystem::directory_iterator(data() / series.folder))
            if (entry.path().filename().string().starts_with(series.pattern))
                names.push_back(entry.path().string());
        std::ranges::sort(names);
        return names;
    }
    /// RAW files need a description.
    std::vector<std::string> described(const RealSeries& series, std::vector<std::string> names) const {
        const std::string folder = series.folder;
        if (folder != "static/headsq" && !contains(names.front(), ".raw")) return names;
        std::ranges::sort(names, [](const std::string& a, const std::string& b) {
            return a.size() != b.size() ? a.size() < b.size() : a < b;
        });
        const bool head = folder == "static/headsq";
        std::ofstream(folder_ / "raw.json") << Json({{"format", "isoglass-raw"},
                                                     {"version", 1},
                                                     {"type", head ? "u16" : "u8"},
                                                     {"endian", "little"},
                                                     {"dims", series.dims},
                                                     {"spacing", series.spacing},
                                                     {"files", names}});
        return {"raw.json"};
    }
};

TEST_P(RealFormats, AreImportedAsTheirReadmeSays) {
    const RealSeries& series = GetParam();
    if (data().empty()) GTEST_SKIP() << "ISOGLASS_DATA is not set";
    if (series.needsVtk && !ISOGLASS_VTK) GTEST_SKIP() << "built without VTK";
    std::vector<std::string> arguments = {"import"};
    for (const std::string& name : described(series, filesOf(series))) arguments.push_back(name);
    arguments.insert(arguments.end(), series.options.begin(), series.options.end());
    arguments.insert(arguments.end(), {"-o", "a.vdb"});
    run(arguments);
    const Json found = info("a.vdb");
    EXPECT_EQ(found.at("dims"), Json(series.dims));
    EXPECT_EQ(found.at("times").size(), series.steps);
    for (std::size_t k = 0; k < 3; ++k) {
        const Json& axis = found.at("axes").at(k);
        const double step =
            (axis.at("last").get<double>() - axis.at("first").get<double>()) / (series.dims[k] - 1);
        // Headers hold floats, seven digits.
        EXPECT_NEAR(step, series.spacing[k], 1e-6 * std::abs(series.spacing[k])) << k;
    }
    EXPECT_NEAR(found.at("range").at(0), series.range[0], 0.05);
    EXPECT_NEAR(found.at("range").at(1), series.range[1], 0.05);
    EXPECT_EQ(found.at("missing_fraction"), 0);
}

INSTANTIATE_TEST_SUITE_P(
    , RealFormats,
    testing::Values(
        RealSeries{"storm", "Storm.pvm-t", {}, {28, 28, 23}, 21, {1, 1, 1}, {0, 255}},
        RealSeries{"isabel",
                   "isabel_",
                   {"--time-from-name"},
                   {125, 125, 25},
                   8,
                   {4.008032, 4.008032, 4.040816},
                   {0, 78.7},
                   true},
        RealSeries{"fingers", "0", {"--time-from-name"}, {64, 64, 64}, 16, {1, 1, 1}, {0, 118.85}, true},
        RealSeries{"asl", "mpld", {}, {64, 64, 24}, 25, {-3.4375, 3.4375, 4.95}, {0, 2839}},
        RealSeries{"static", "engine_256x256x128_uint8", {}, {256, 256, 128}, 1, {1, 1, 1}, {0, 255}},
        RealSeries{"static", "neghip", {}, {66, 66, 66}, 1, {1, 1, 1}, {0, 255}},
        RealSeries{"static", "hydrogen", {}, {64, 64, 64}, 1, {1, 1, 1}, {0, 1}, true},
        RealSeries{"static/headsq", "quarter.", {}, {64, 64, 93}, 1, {3.2, 3.2, 1.5}, {0, 3926}}));

}  // namespace
}  // namespace isoglass::test
