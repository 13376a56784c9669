#include "formats/raw_export.h"
#include "formats/raw_json.h"
#include "support/file_size_limit.h"
#include "unit/formats/small_files.h"
#include "unit/volume/series_fixture.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <map>
#include <set>

namespace isoglass {

namespace {

using nlohmann::json;
using test::expectWorldValues;
using test::failsWith;
using test::SmallArray;
using test::write;

class Raw : public testing::Test {
  protected:
    ScratchFolder folder_;

    /// A description of u8 samples in a.raw, with the given keys put over it; null takes one away.
    json description(const json& changes = json::object()) const {
        json text = {{"format", "isoglass-raw"},
                     {"version", 1},
                     {"type", "u8"},
                     {"dims", {5, 4, 3, 2}},
                     {"files", "a.raw"}};
        text.merge_patch(changes);
        return text;
    }
    std::filesystem::path file(const json& text) const {
        write(folder_ / "a.json", text.dump());
        return folder_ / "a.json";
    }
    std::unique_ptr<FileSource> open(const json& changes) const {
        return openRaw(file(description(changes)), "");
    }
};

template <typename Stored>
void expectType(const ScratchFolder& folder, const char* name) {
    for (const bool bigEndian : {false, true}) {
        write(folder / "a.raw", test::packed<Stored>(SmallArray{}.values(), bigEndian));
        write(folder / "a.json", json({{"format", "isoglass-raw"},
                                       {"version", 1},
                                       {"type", name},
                                       {"endian", bigEndian ? "big" : "little"},
                                       {"dims", {5, 4, 3, 2}},
                                       {"files", "a.raw"}})
                                     .dump());
        expectWorldValues(*openRaw(folder / "a.json", ""));
    }
}

TEST_F(Raw, EveryTypeIsReadInBothByteOrders) {
    expectType<std::uint8_t>(folder_, "u8");
    expectType<std::int16_t>(folder_, "i16");
    expectType<std::uint16_t>(folder_, "u16");
    expectType<std::int32_t>(folder_, "i32");
    expectType<std::uint32_t>(folder_, "u32");
    expectType<std::int64_t>(folder_, "i64");
    expectType<std::uint64_t>(folder_, "u64");
    expectType<float>(folder_, "f32");
    expectType<double>(folder_, "f64");
}

TEST_F(Raw, SignedBytesAreSigned) {
    write(folder_ / "a.raw", "\xff\x80\x7f" + std::string(5, '\0'));
    const auto samples = test::readFrame(*open({{"type", "i8"}, {"dims", {2, 2, 2}}}), 0);
    EXPECT_EQ((std::vector<float>(samples.begin(), samples.begin() + 3)),
              (std::vector<float>{-1, -128, 127}));
}

TEST_F(Raw, OneFileAStepOrASliceOrAll) {
    const std::string samples = test::packed<std::uint8_t>(SmallArray{}.values());
    json steps = json::array(), slices = json::array();
    for (std::size_t i = 0; i < 2; ++i) {
        steps.push_back("t" + std::to_string(i));
        write(folder_ / steps[i], samples.substr(i * 60, 60));
    }
    for (std::size_t i = 0; i < 6; ++i) {
        slices.push_back("z" + std::to_string(i));
        write(folder_ / slices[i], test::deflated(samples.substr(i * 20, 20)));
    }
    expectWorldValues(*open({{"files", steps}}));
    expectWorldValues(*open({{"files", slices}}));
    write(folder_ / "a.raw", "four" + samples);
    expectWorldValues(*open({{"skip", 4}}));
    write(folder_ / "a.raw", test::deflated("four" + samples));
    expectWorldValues(*open({{"skip", 4}}));
    expectWorldValues(*open({{"skip", 4}, {"gzip", true}}));
    EXPECT_TRUE(failsWith([&] { open({{"skip", 4}, {"gzip", false}}); }, {"announces 120", "a.raw"}));
}

TEST_F(Raw, AxesTimesAndMissingAreTaken) {
    write(folder_ / "a.raw", test::packed<float>({1, 2, -999, 4, 5, 6, 7, 1e30f, 9, 10, 11, INFINITY}));
    const json axes = {
        {{"name", "lon"}, {"units", "degrees_east"}, {"coordinates", {0, 180}}, {"period", 360}},
        {{"coordinates", {5, 4}}},
        {{"name", "depth"}, {"coordinates", {-1, -10, -100}}, {"negated", true}}};
    const auto source =
        open({{"type", "f32"},
              {"endian", "little"},
              {"dims", {2, 2, 3}},
              {"axes", axes},
              {"missing", -999},
              {"name", "T"},
              {"units", "K"},
              {"time", {{"times", {7.5}}, {"units", "days since 2000-01-01"}, {"calendar", "noleap"}}}});
    const SeriesDescription& series = source->description();
    EXPECT_EQ(series.lattice.axes[0].period, 360);
    EXPECT_TRUE(series.lattice.axes[1].descending());
    EXPECT_TRUE(series.lattice.axes[2].negated);
    EXPECT_EQ(series.lattice.axes[2].coordinates[2], -100);
    EXPECT_EQ(series.time.times, std::vector<double>{7.5});
    EXPECT_EQ(series.time.calendar, "noleap");
    EXPECT_EQ(series.units, "K");
    const auto samples = test::readFrame(*source, 0);
    EXPECT_TRUE(std::isnan(samples[2]));
    EXPECT_TRUE(std::isnan(samples[11]));
    EXPECT_EQ(samples[7], 1e30f);
}

// The float next to 1e20 is not 1e20.
TEST_F(Raw, MissingValueIsComparedInTheTypeOfTheFile) {
    std::vector<float> values(8, 1);
    values[3] = 1e20f;
    write(folder_ / "a.raw", test::packed<float>(values));
    const auto source = open({{"type", "f32"}, {"endian", "little"}, {"dims", {2, 2, 2}}, {"missing", 1e20}});
    EXPECT_TRUE(std::isnan(test::readFrame(*source, 0)[3]));
}

TEST_F(Raw, MistakesAreNamedWithTheirPlace) {
    write(folder_ / "a.raw", std::string(120, '\1'));
    struct Case {
        json changes;
        std::initializer_list<std::string_view> says;
    };
    const json goodAxis = {{"coordinates", {0, 1, 2, 3, 4}}};
    const std::vector<Case> cases = {
        {{{"format", "raw"}}, {"/format", "isoglass-raw"}},
        {{{"format", nullptr}}, {"/format", "missing"}},
        {{{"version", 2}}, {"/version"}},
        {{{"spacng", 1}}, {"/spacng", "did you mean \"spacing\""}},
        {{{"type", "u9"}}, {"/type", "u8, i8"}},
        {{{"type", 8}}, {"/type"}},
        {{{"type", "u16"}}, {"/endian", "missing"}},
        {{{"endian", "LE"}}, {"/endian", "little"}},
        {{{"dims", 5}}, {"/dims", "array"}},
        {{{"dims", {5, 4}}}, {"/dims", "array of 3"}},
        {{{"dims", {5, 4, -3}}}, {"/dims/2", "whole number"}},
        {{{"dims", {5, 4, 2.5}}}, {"/dims/2", "whole number"}},
        {{{"dims", {5, 4, 1, 2}}}, {"axis of 1"}},
        {{{"dims", {1000000, 1000000, 1000000}}}, {"2^34"}},
        {{{"dims", {5, 4, 3, 1000000}}}, {"announces 60000000", "120 follow"}},
        {{{"dims", {5, 4, 3}}}, {"announces 60", "120 follow"}},
        {{{"spacing", {1, 0, 1}}}, {"/spacing/1"}},
        {{{"spacing", {1, "wide", 1}}}, {"/spacing/1", "number"}},
        {{{"origin", {1, 0}}}, {"/origin", "array of 3"}},
        {{{"files", 7}}, {"/files", "text"}},
        {{{"files", json::array()}}, {"/files"}},
        {{{"files", {"a.raw", 7}}}, {"/files/1", "text"}},
        {{{"files", "absent.raw"}}, {"no such file", "absent.raw"}},
        {{{"files", {"a.raw", "a.raw", "a.raw", "a.raw", "a.raw", "a.raw", "a.raw"}}}, {"do not divide"}},
        {{{"skip", -1}}, {"/skip"}},
        {{{"gzip", "yes"}}, {"/gzip"}},
        {{{"gzip", true}}, {"damaged", "a.raw"}},
        {{{"missing", "nan"}}, {"/missing"}},
        {{{"time", {{"times", {0, 0}}}}}, {"/time/times", "index 1"}},
        {{{"time", {{"times", {1, 0}}}}}, {"/time/times", "index 1"}},
        {{{"time", {{"times", {1, 2, 3}}}}}, {"/time/times", "3 times"}},
        {{{"time", {{"tims", {1, 2}}}}}, {"/time/tims", "times"}},
        {{{"time", {{"times", {0, 1}}, {"period", 1}}}}, {"/time/period"}},
        {{{"axes", {goodAxis}}}, {"/axes", "array of 3"}},
        {{{"axes", {goodAxis, goodAxis, goodAxis}}}, {"/axes/1/coordinates", "array of 4"}},
        {{{"axes", {{{"coordinates", {0, 1, 1, 3, 4}}}, goodAxis, goodAxis}}},
         {"/axes/0/coordinates/2", "strictly"}},
        {{{"axes", {{{"coordinates", {0, 1, 2, 3, 4}}, {"period", 4}}, goodAxis, goodAxis}}},
         {"/axes/0/period"}},
        {{{"axes", {{{"name", "x"}}, goodAxis, goodAxis}}}, {"/axes/0/coordinates", "missing"}},
        {{{"axes", {goodAxis, goodAxis, goodAxis}}, {"spacing", {1, 1, 1}}}, {"/spacing", "already"}},
    };
    for (const Case& bad : cases)
        EXPECT_TRUE(failsWith([&] { test::readFrame(*open(bad.changes), 0); }, bad.says)) << bad.changes;
    write(folder_ / "a.json", "{\"format\": ");
    EXPECT_TRUE(failsWith([&] { openRaw(folder_ / "a.json", ""); }, {"not valid JSON", "line 1"}));
    EXPECT_TRUE(failsWith(
        [&] {
            openRaw(file(description({{"name", "T"}})), "U");
        },
        {"no variable \"U\"", "\"T\""}));
}

/// Keys of each object of the schema by its pointer, with `*` for the place in an array.
void collect(const json& part, const std::string& pointer,
             std::map<std::string, std::set<std::string>>& keys) {
    if (part.contains("items") && part["items"].is_object()) collect(part["items"], pointer + "/*", keys);
    if (!part.contains("properties")) return;
    EXPECT_EQ(part.value("additionalProperties", json()), json(false)) << pointer;
    for (const auto& [key, value] : part["properties"].items()) {
        EXPECT_TRUE(value.contains("description")) << pointer << '/' << key;
        keys[pointer].insert(key);
        collect(value, pointer + "/" + key, keys);
    }
}

TEST(RawSchema, HasTheKeysThatAreReadAndNoOthers) {
    std::map<std::string, std::set<std::string>> inSchema, inReader;
    collect(json::parse(std::ifstream(ISOGLASS_DATA_FOLDER "/raw.schema.json")), "", inSchema);
    for (const RawObject& object : rawFormat())
        inReader[std::string(object.pointer)] = {object.keys.begin(), object.keys.end()};
    EXPECT_EQ(inSchema, inReader);
}

/// Every kind of axis and of time, and holes.
test::MemorySource richSource() {
    const glm::ivec3 dims(17, 9, 10);
    Lattice lattice = makeUniformLattice(dims, glm::dvec3(0.1), glm::dvec3(1.0 / 3));
    lattice.axes[0].period = 17;
    lattice.axes[0].units = "degrees_east";
    for (double& value : lattice.axes[1].coordinates) value = -value * value;
    lattice.axes[2].negated = true;
    SeriesDescription series = test::describe(lattice, 3);
    series.time = {{0.1, 0.7, 100.0 / 3}, "hours since 1900-01-01", "noleap", 8760.5};
    series.longName = "A \"field\"";
    series.units = "m/s";
    std::vector<std::vector<float>> frames;
    for (std::uint32_t i = 0; i < 3; ++i) {
        frames.push_back(randomFloats(dims, i));
        removeSamples(frames.back(), 20, i + 9);
    }
    std::fill_n(frames[1].begin(), 17 * 9 * 8, 4.0f);
    return {series, frames};
}

TEST(RawExport, ImportExportImportGivesTheSameSeries) {
    const ScratchFolder folder;
    auto source = richSource();
    writeSeries(source, folder / "first.vdb");
    writeRaw(SeriesFile(folder / "first.vdb"), folder / "out.json");
    const auto again = openRaw(folder / "out.json", "");
    writeSeries(*again, folder / "second.vdb");

    const SeriesFile first(folder / "first.vdb"), second(folder / "second.vdb");
    const SeriesDescription &a = first.description(), &b = second.description();
    for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_EQ(a.lattice.axes[k].name, b.lattice.axes[k].name);
        EXPECT_EQ(a.lattice.axes[k].units, b.lattice.axes[k].units);
        EXPECT_EQ(a.lattice.axes[k].coordinates, b.lattice.axes[k].coordinates);
        EXPECT_EQ(a.lattice.axes[k].negated, b.lattice.axes[k].negated);
        EXPECT_EQ(a.lattice.axes[k].period, b.lattice.axes[k].period);
    }
    EXPECT_EQ(a.time.times, b.time.times);
    EXPECT_EQ(a.time.units, b.time.units);
    EXPECT_EQ(a.time.calendar, b.time.calendar);
    EXPECT_EQ(a.time.period, b.time.period);
    EXPECT_EQ(a.name, b.name);
    EXPECT_EQ(a.longName, b.longName);
    EXPECT_EQ(a.units, b.units);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(a.frames[i].checksum, b.frames[i].checksum);
        EXPECT_EQ(a.frames[i].validSamples, b.frames[i].validSamples);
        EXPECT_EQ(test::firstDifference(*second.read(i), source.frame(i)), -1);
    }
    writeRaw(second, folder / "out2.json");
    EXPECT_EQ(test::contentOf(folder / "out2.raw"), test::contentOf(folder / "out.raw"));
}

TEST(RawExport, FullDiskLeavesNothingBehind) {
    const ScratchFolder folder;
    auto source = richSource();
    writeSeries(source, folder / "a.vdb");
    const SeriesFile series(folder / "a.vdb");
    for (const rlim_t bytes : {0, 1000, 10'000}) {
        const FileSizeLimit limit(bytes);
        EXPECT_TRUE(failsWith([&] { writeRaw(series, folder / "out.json"); }, {"out."})) << bytes;
        EXPECT_EQ(folder.fileCount(), 1u) << bytes;
    }
    EXPECT_TRUE(
        failsWith([&] { writeRaw(series, folder / "no" / "out.json"); }, {"folder does not exist", "no"}));
}

}  // namespace

}  // namespace isoglass
