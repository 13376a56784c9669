#include "vtkio/vtk_image.h"

#include "unit/formats/small_files.h"

#include <gtest/gtest.h>

namespace isoglass {

namespace {

using test::expectWorldValues;
using test::failsWith;
using test::hasNote;
using test::SmallArray;
using test::write;

/// How a .vti is written.
struct VtiOptions {
    std::string more = "";        ///< further elements in <ImageData>, before the piece
    std::string morePoints = "";  ///< further arrays of points
    std::string moreCells = "";
    bool appended = false;  ///< raw bytes at the end instead of text
};

class VtkImage : public testing::Test {
  protected:
    ScratchFolder folder_;

    /// The array "f" of key frame `frame`; its first sample has the extent 2, 0, -1.
    static std::string vti(const SmallArray& array, const VtiOptions& options = {}) {
        std::ostringstream text, extent;
        extent << "2 " << array.lengths[0] + 1 << " 0 " << array.lengths[1] - 1 << " -1 "
               << array.lengths[2] - 2;
        const AffinePlace& place = array.place;
        const glm::dvec3 origin = place.origin - 2.0 * place.steps[0] + place.steps[2];
        text
            << R"(<VTKFile type="ImageData" version="0.1" byte_order="LittleEndian"><ImageData WholeExtent=")"
            << extent.str() << "\" Origin=\"" << test::vectorText(origin) << "\" Spacing=\"";
        for (const glm::dvec3& step : place.steps) text << glm::length(step) << ' ';
        text << "\" Direction=\"";
        for (int row = 0; row < 3; ++row)
            for (const glm::dvec3& step : place.steps) text << step[row] / glm::length(step) << ' ';
        text << "\">" << options.more << "<Piece Extent=\"" << extent.str()
             << R"("><PointData><DataArray type="Float32" Name="f" format=)";
        const std::vector<float> values = array.values();
        if (options.appended) {
            text << R"("appended" offset="0"/>)";
        } else {
            text << "\"ascii\">";
            for (const float value : values) text << value << ' ';
            text << "</DataArray>";
        }
        text << options.morePoints << "</PointData><CellData>" << options.moreCells
             << "</CellData></Piece></ImageData>";
        if (options.appended) {
            std::string size(4, '\0');
            test::put(size, 0, static_cast<std::uint32_t>(4 * values.size()));
            text << R"(<AppendedData encoding="raw">_)" << size << test::packed<float>(values)
                 << "</AppendedData>";
        }
        text << "</VTKFile>\n";
        return text.str();
    }

    std::filesystem::path file(const std::string& name, const std::string& bytes) const {
        write(folder_ / name, bytes);
        return folder_ / name;
    }
    static std::unique_ptr<FrameSource> open(const std::vector<std::filesystem::path>& files,
                                             const ImportOptions& options = {}) {
        return openVtkImages(files, options);
    }
    /// A field of the file with one number.
    static std::string field(const std::string& name, double value) {
        return "<FieldData><DataArray type=\"Float64\" Name=\"" + name +
               "\" NumberOfTuples=\"1\" format=\"ascii\">" + std::to_string(value) +
               "</DataArray></FieldData>";
    }
};

const SmallArray kArray{.frames = 1};

TEST_F(VtkImage, ExtentOriginSpacingAndDirectionPlaceTheSamples) {
    for (const bool appended : {false, true})
        expectWorldValues(*open({file("a.vti", vti(kArray, {.appended = appended}))}), 1);
    const SmallArray turned{.frames = 1,
                            .place = {{3, -2, 1}, {glm::dvec3{0, -1, 0}, {0, 0, 2}, {-4, 0, 0}}}};
    const auto source = open({file("turned.vti", vti(turned))});
    expectWorldValues(*source, 1);
    EXPECT_TRUE(source->description().lattice.axes[0].descending());
    EXPECT_TRUE(hasNote(source->description(), "reordered"));
    const SmallArray moved{.frames = 1,
                           .place = {{0.5, 0.25, 8}, {glm::dvec3{0.5, 0, 0}, {0, 2, 0}, {0, 0, 4}}}};
    expectWorldValues(*open({file("moved.vti", vti(moved))}), 1);
}

TEST_F(VtkImage, ArrayIsChosenByItsName) {
    const std::string vectors =
        R"(<DataArray type="Float32" Name="v" NumberOfComponents="2" format="ascii">)";
    std::string values, cells;
    for (int i = 0; i < 60; ++i) values += std::to_string(i) + " " + std::to_string(-i) + " ";
    for (int i = 0; i < 4 * 3 * 2; ++i) cells += std::to_string(i) + " ";
    const auto path =
        file("a.vti", vti(kArray, {.morePoints = vectors + values + "</DataArray>",
                                   .moreCells = R"(<DataArray type="UInt8" Name="c" format="ascii">)" +
                                                cells + "</DataArray>"}));
    EXPECT_TRUE(failsWith([&] { open({path}); }, {"several arrays", "f, v, c (cells)", "a.vti"}));
    expectWorldValues(*open({path}, {"f", {}}), 1);
    EXPECT_TRUE(failsWith([&] { open({path}, {"v", {}}); }, {"2 components", "v:0 to v:1"}));
    EXPECT_TRUE(failsWith([&] { open({path}, {"v:2", {}}); }, {"2 components"}));
    EXPECT_TRUE(failsWith([&] { open({path}, {"g", {}}); }, {"no array \"g\"", "f, v, c (cells)"}));
    EXPECT_EQ(test::readFrame(*open({path}, {"v:1", {}}), 0)[59], -59);
    const auto inCells = open({path}, {"c", {}});
    EXPECT_EQ(inCells->description().lattice.dims(), glm::ivec3(4, 3, 2));
    EXPECT_EQ(inCells->description().lattice.axes[0].coordinates, (std::vector<double>{0.5, 1.5, 2.5, 3.5}));
    EXPECT_EQ(test::readFrame(*inCells, 0)[23], 23);
}

TEST_F(VtkImage, HiddenPointsAndNotANumberAreMissing) {
    std::string ghosts = R"(<DataArray type="UInt8" Name="vtkGhostType" format="ascii">)";
    for (int i = 0; i < 60; ++i) ghosts += i == 7 ? "2 " : i == 8 ? "1 " : "0 ";
    const auto samples =
        test::readFrame(*open({file("a.vti", vti(kArray, {.morePoints = ghosts + "</DataArray>"}))}), 0);
    for (std::size_t i = 0; i < 60; ++i) EXPECT_EQ(std::isnan(samples[i]), i == 7) << i;
}

TEST_F(VtkImage, TimesOfTheFilesAreTaken) {
    const auto a = file("a.vti", vti(kArray, {.more = field("TimeValue", 2.5)}));
    const auto b = file("b.vti", vti(kArray, {.more = field("TimeStep", 7)}));
    const auto c = file("c.vti", vti(kArray));
    EXPECT_EQ(open({a, b})->description().time.times, (std::vector<double>{2.5, 7}));
    EXPECT_EQ(open({a, c})->description().time.times, (std::vector<double>{0, 1}));
    EXPECT_EQ(open({a, b}, {"", {1, 3}})->description().time.times, (std::vector<double>{1, 3}));
    EXPECT_TRUE(failsWith([&] { open({b, a}); }, {"strictly increase"}));
    EXPECT_TRUE(failsWith([&] { open({a, a}); }, {"strictly increase"}));
}

TEST_F(VtkImage, IndexFilesGiveFilesAndTimes) {
    file("a.vti", vti(kArray));
    file("b.vti", vti({.frames = 1, .place = kArray.place}));
    const auto pvd = [&](const std::string& entries) {
        return file("s.pvd", "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\"><Collection>" + entries +
                                 "</Collection></VTKFile>");
    };
    const auto json = [&](const std::string& text) { return file("s.vti.series", text); };
    const std::string one = R"(<DataSet timestep="0.5" group="" part="0" file="a.vti"/>)";
    const auto source = openVtkSeries(pvd(one + R"(<DataSet timestep="2" file="b.vti"/>)"), {});
    expectWorldValues(*openVtkSeries(pvd(one), {}), 1);
    EXPECT_EQ(source->description().time.times, (std::vector<double>{0.5, 2}));
    EXPECT_EQ(test::readFrame(*source, 1)[4], 4);
    EXPECT_EQ(openVtkSeries(json(R"({"file-series-version": "1.0",
                "files": [{"name": "a.vti", "time": 1}, {"name": "b.vti", "time": 4.5}]})"),
                            {})
                  ->description()
                  .time.times,
              (std::vector<double>{1, 4.5}));
    EXPECT_TRUE(
        failsWith([&] { openVtkSeries(pvd(one + one), {}); }, {"strictly increase", "index 1", "s.pvd"}));
    EXPECT_TRUE(failsWith([&] { openVtkSeries(pvd(""), {}); }, {"lists no files", "s.pvd"}));
    EXPECT_TRUE(
        failsWith([&] { openVtkSeries(pvd(R"(<DataSet timestep="1"/>)"), {}); }, {"\"file\"", "DataSet 1"}));
    EXPECT_TRUE(failsWith([&] { openVtkSeries(pvd(R"(<DataSet file="a.vti" timestep="noon"/>)"), {}); },
                          {"timestep", "DataSet 1"}));
    EXPECT_TRUE(failsWith([&] { openVtkSeries(pvd(R"(<DataSet file="a.vti" timestep="1" part="1"/>)"), {}); },
                          {"several parts", "DataSet 1"}));
    EXPECT_TRUE(failsWith([&] { openVtkSeries(pvd(R"(<DataSet file="no.vti" timestep="1"/>)"), {}); },
                          {"no such file", "no.vti"}));
    EXPECT_TRUE(failsWith([&] { openVtkSeries(file("s.pvd", "<VTKFile"), {}); }, {"s.pvd"}));
    EXPECT_TRUE(failsWith([&] { openVtkSeries(file("s.pvd", "<VTKFile/>"), {}); }, {"not a PVD", "s.pvd"}));
    EXPECT_TRUE(failsWith([&] { openVtkSeries(json("{"), {}); }, {"not a series", "s.vti.series"}));
    EXPECT_TRUE(
        failsWith([&] { openVtkSeries(json(R"({"files": [{"name": "a.vti"}]})"), {}); }, {"not a series"}));
    EXPECT_TRUE(failsWith([&] { openVtkSeries(folder_ / "absent.pvd", {}); }, {"absent.pvd"}));
    EXPECT_TRUE(failsWith([&] { openVtkSeries(folder_ / "absent.vti.series", {}); }, {"absent.vti.series"}));
}

TEST_F(VtkImage, FilesThatAreWrongAreRefused) {
    const std::string good = vti(kArray, {.appended = true});
    const auto changed = [&](const std::string& from, const std::string& to) {
        std::string bytes = good;
        for (std::size_t at = 0; (at = bytes.find(from, at)) != std::string::npos; at += to.size())
            bytes.replace(at, from.size(), to);
        return file("a.vti", bytes);
    };
    EXPECT_TRUE(failsWith([&] { open({changed("ImageData", "RectilinearGrid")}); }, {"a.vti"}));
    EXPECT_TRUE(failsWith([&] { open({changed("2 6 0 3 -1 1", "2 6 0 3 0 0")}); }, {"axis of 1", "a.vti"}));
    EXPECT_TRUE(failsWith([&] { open({changed("2 6 0 3 -1 1", "2 600 0 3 -1 1")}); }, {"a.vti"}));
    EXPECT_TRUE(
        failsWith([&] { open({changed("2 6 0 3 -1 1", "0 900000 0 900000 0 900000")}); }, {"2^34", "a.vti"}));
    EXPECT_TRUE(failsWith([&] { open({changed("2 6 0 3 -1 1", "0 200000 0 20000 0 3")}); }, {"a.vti"}));
    EXPECT_TRUE(failsWith([&] { open({changed("Float32", "Float99")}); }, {"a.vti"}));
    EXPECT_TRUE(failsWith([&] { open({changed("Spacing=\"1 1 1", "Spacing=\"1 0 1")}); },
                          {"makes no sense", "a.vti"}));
    EXPECT_TRUE(failsWith([&] { open({file("a.vti", "")}); }, {"a.vti"}));
    EXPECT_TRUE(failsWith([&] { open({file("a.vti", "not XML")}); }, {"a.vti"}));
    EXPECT_TRUE(failsWith([&] { open({folder_ / "absent.vti"}); }, {"no such file", "absent.vti"}));
    EXPECT_TRUE(failsWith(
        [&] {
            open({file("a.vti", good), file("b.vti", vti({.lengths = {5, 4, 4}, .frames = 1}))});
        },
        {"dimensions differ", "b.vti"}));
}

// VTK takes any size; what it does not read stays as the memory was.
TEST_F(VtkImage, SizeOfAppendedSamplesMustFit) {
    for (const std::uint32_t bytes : {0u, 236u, 244u, 0xffffffffu}) {
        std::string content = vti(kArray, {.appended = true});
        test::put(content, content.find(">_") + 2, bytes);
        const auto path = file("a.vti", content);
        EXPECT_TRUE(failsWith([&] { open({path}); }, {"a.vti"})) << bytes;
    }
}

TEST_F(VtkImage, NothingIsPrinted) {
    testing::internal::CaptureStderr();
    testing::internal::CaptureStdout();
    EXPECT_TRUE(failsWith([&] { open({file("a.vti", "not XML")}); }, {"a.vti"}));
    EXPECT_TRUE(failsWith([&] { openVtkSeries(file("s.pvd", "<VTKFile"), {}); }, {"s.pvd"}));
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
    EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
}

// VTK's readers crash, loop or go on with garbage for some of these; all is caught or read.
TEST_F(VtkImage, DamageNeverCrashes) {
    const std::string good = vti(kArray, {.appended = true});
    const std::size_t payload = good.find(">_") + 2;
    const auto read = [&](const std::string& bytes) {
        try {
            test::readFrame(*open({file("a.vti", bytes)}), 0);
            return true;
        } catch (const Error& error) {
            EXPECT_NE(std::string(error.what()).find("a.vti"), std::string::npos) << error.what();
            return false;
        }
    };
    ASSERT_TRUE(read(good));
    std::size_t refused = 0;
    // The header and the size of the samples, every byte; samples have no checksum.
    for (std::size_t position = 0; position < payload + 6; position += 5) {
        std::string bytes = good;
        bytes[position] = static_cast<char>(bytes[position] ^ (1 << position % 8));
        refused += !read(bytes);
    }
    EXPECT_GT(refused, 50u);
    for (std::size_t size = 0; size < good.size() - 1; size += 17)
        EXPECT_FALSE(read(good.substr(0, size))) << size;
}

}  // namespace

}  // namespace isoglass
