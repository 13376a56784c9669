#include "app/app_test.h"
#include "volume/series_seal.h"

#include <nlohmann/json.hpp>

namespace isoglass::test {
namespace {

using Json = nlohmann::json;

using List = std::vector<std::string>;

class Validate : public AppTest {
  protected:
    void SetUp() override { importOcean(); }

    void write(const std::string& name, const std::string& text) const {
        std::ofstream(folder_ / name, std::ios::binary) << text;
    }

    /// The ocean's series changed and sealed again: the seal holds, the checksums of key frames 3 and 7 do not.
    void writeDamaged(const std::string& name) const {
        std::string bytes = bytesOf("ocean.vdb");
        bytes.resize(bytes.size() - 24);  // the seal
        const std::string key = "\"crc32\":";
        std::size_t place = bytes.find(key);
        // Each of the 12 key frames has its own, then those of its three coarser levels.
        for (int i = 0; i < 12 * 4; ++i, place = bytes.find(key, place + 1)) {
            ASSERT_NE(place, std::string::npos) << i;
            char& digit = bytes[bytes.find_first_of(",}", place) - 1];
            if (i == 3 * 4 || i == 7 * 4 + 2) digit = digit == '0' ? '1' : '0';
        }
        write(name, bytes);
        sealFile(folder_ / name, folder_ / name);
    }

    /// Severity and pointer of every problem, in order.
    std::vector<std::string> problems(const std::string& file, int status) const {
        const RunResult result = isoglass({"validate", file, "--json"});
        EXPECT_EQ(result.status, status) << result.out << result.err;
        EXPECT_EQ(result.err, "");
        std::vector<std::string> list;
        const Json report = Json::parse(result.out);
        EXPECT_EQ(report.at("file"), file);
        EXPECT_EQ(report.at("valid"), status == 0);
        for (const Json& problem : report.at("problems")) {
            list.push_back(problem.at("severity").get<std::string>() + ' ' +
                           problem.at("pointer").get<std::string>());
            EXPECT_FALSE(problem.at("what").get<std::string>().empty());
        }
        return list;
    }
};


TEST_F(Validate, AValidSceneAndSeriesAreCalledSo) {
    writeScene();
    EXPECT_EQ(run({"validate", "scene.json"}).out, "scene.json: a valid scene\n");
    EXPECT_EQ(run({"validate", "ocean.vdb"}).out, "ocean.vdb: a valid series\n");
    EXPECT_EQ(problems("scene.json", 0), List{});
    EXPECT_EQ(problems("ocean.vdb", 0), List{});
}

/// One error of each kind in one file; each is named once, with its place, and hides none of the others.
TEST_F(Validate, FindsEveryErrorOfAScene) {
    write("wrong.json", R"({"version": 2, "colour": 1,
        "volumes": [{"series": "ocean.vdb", "surfaces": [{"iso": "warm"}, {"iso": 20, "opacity": 1.5},
                                                         {"color": "red", "iso": 10}, {"inside": "up"}]},
                    7,
                    {"series": "absent.vdb", "place": {"scale": [1, 0, 1]}, "surfaces": [{"iso": 1}]}],
        "camera": {"eye": [1, 2], "fov": 400, "ayes": 1},
        "image": {"size": [0, 10], "exposure": "bright", "background": "#12"},
        "time": {"fps": -1}})");
    const List found = problems("wrong.json", 1);
    const std::set<std::string> places(found.begin(), found.end());
    EXPECT_EQ(places.size(), found.size()) << "a place is named twice";
    EXPECT_EQ(places,
              (std::set<std::string>{
                  "error /version", "error /colour", "error /volumes/0/surfaces/0/iso",
                  "error /volumes/0/surfaces/1/opacity", "error /volumes/0/surfaces/2/color",
                  "error /volumes/0/surfaces/3/iso", "error /volumes/0/surfaces/3/inside", "error /volumes/1",
                  "error /volumes/2/series", "error /volumes/2/place/scale/1", "error /camera/eye",
                  "error /camera/fov", "error /camera/ayes", "error /image/size/0", "error /image/exposure",
                  "error /image/background", "error /time/fps"}));
}

TEST_F(Validate, TextNamesFilePointerAndHowToMendIt) {
    write("wrong.json", R"({"version": 1, "tansparency": {}, "volumes": [{"series": "ocean.vdb",
                            "surfaces": [{"iso": 20, "colr": 1}]}]})");
    const RunResult result = isoglass({"validate", "wrong.json"});
    EXPECT_EQ(result.status, 1);
    EXPECT_EQ(result.out, "wrong.json: 2 errors\n");
    for (const char* part : {"isoglass: error: unknown key \"tansparency\" (wrong.json, /tansparency); did "
                             "you mean \"transparency\"?",
                             "isoglass: error: unknown key \"colr\" (wrong.json, "
                             "/volumes/0/surfaces/0/colr); did you mean \"color\"?"}) {
        EXPECT_TRUE(contains(result.err, part)) << part << " is not in\n" << result.err;
    }
}

TEST_F(Validate, ChecksTheScenesSeries) {
    const auto scene = [](const std::string& volume, const std::string& more) {
        return R"({"version": 1, "volumes": [{"series": "ocean.vdb", )" + volume + "}]" + more + "}";
    };
    write("grid.json", scene(R"("grid": "SALT", "surfaces": [{"iso": 20}])", ""));
    EXPECT_EQ(problems("grid.json", 1), List{"error /volumes/0/grid"});
    write("iso.json", scene(R"("surfaces": [{"iso": 20}, {"iso": 99}])", ""));
    EXPECT_EQ(problems("iso.json", 0), List{"warning /volumes/0/surfaces/1/iso"});
    write("date.json", scene(R"("surfaces": [{"iso": 20}])", R"(, "time": {"from": "0001-02-31"})"));
    EXPECT_EQ(problems("date.json", 1), List{"error /time"});
    write("lost.json", R"({"version": 1, "volumes": [{"series": "no.vdb", "surfaces": [{"iso": 1}]},
                                                     {"series": "wrong.vdb", "surfaces": [{"iso": 1}]}]})");
    write("wrong.vdb", "text");
    EXPECT_EQ(problems("lost.json", 1), (List{"error /volumes/0/series", "error /volumes/1/series"}));
}

TEST_F(Validate, WarnsOfTimesWithoutKeyFrames) {
    for (const char* name : {"a.pvm", "b.pvm"}) write(name, "PVM\n2 2 2\n1\nabcdefgh");
    run({"import", "a.pvm", "b.pvm", "-o", "pvm.vdb"});
    write("late.json", R"({"version": 1, "volumes": [{"series": "pvm.vdb", "surfaces": [{"iso": 100}]}],
                           "time": {"from": 0, "to": 5, "duration": 1}})");
    EXPECT_EQ(problems("late.json", 0), List{"warning /time"});
}

TEST_F(Validate, WarnsOfIsoValuesThatTheImportDidNotKeep) {
    run({"import", ISOGLASS_DATA_FOLDER "/ocean_excerpt.nc", "-o", "kept.vdb", "--keep", "18:22"});
    write("kept.json",
          R"({"version": 1, "volumes": [{"series": "kept.vdb", "surfaces": [{"iso": 20}, {"iso": 10}]}]})");
    EXPECT_EQ(problems("kept.json", 0), List{"warning /volumes/0/surfaces/1/iso"});
}

TEST_F(Validate, ScenesThatAreNoScenes) {
    write("text.json", "{\"version\": 1,\n oops}");
    const RunResult text = isoglass({"validate", "text.json"});
    EXPECT_EQ(text.status, 1);
    EXPECT_TRUE(contains(text.err, "(text.json, line 2, column ")) << text.err;
    write("twice.json", R"({"version": 1, "version": 1})");
    EXPECT_EQ(problems("twice.json", 1), List{"error /version"});
    write("list.json", "[]");
    EXPECT_EQ(problems("list.json", 1), List{"error "});
    EXPECT_EQ(problems("absent.json", 1), List{"error "});
}

TEST_F(Validate, DamagedSeriesBreaksItsSeal) {
    const std::string whole = bytesOf("ocean.vdb");
    for (const std::size_t place : {std::size_t{4}, whole.size() / 2, whole.size() - 1}) {
        std::string damaged = whole;
        damaged[place] = static_cast<char>(damaged[place] ^ 4);
        write("damaged.vdb", damaged);
        EXPECT_EQ(problems("damaged.vdb", 1).size(), 1u) << place;
    }
    write("short.vdb", whole.substr(0, whole.size() / 3));
    EXPECT_EQ(problems("short.vdb", 1).size(), 1u);
}

TEST_F(Validate, NamesEveryDamagedKeyFrame) {
    writeDamaged("changed.vdb");
    const RunResult result = isoglass({"validate", "changed.vdb"});
    EXPECT_EQ(result.status, 1);
    EXPECT_EQ(result.out, "changed.vdb: 2 errors\n");
    EXPECT_TRUE(contains(result.err, "checksum")) << result.err;
    EXPECT_TRUE(contains(result.err, "(changed.vdb, key frame 3)")) << result.err;
    EXPECT_TRUE(contains(result.err, "(changed.vdb, key frame 7, level 2)")) << result.err;
}

TEST_F(Validate, ReadsTheKeyFramesOfAScenesSeries) {
    writeDamaged("changed.vdb");
    write("volume.json", R"({"version": 1, "volumes": [{"series": "changed.vdb", "surfaces": [{"iso": 20}]},
                                                       {"series": "changed.vdb", "surfaces": [{"iso": 5}]}]})");
    EXPECT_EQ(problems("volume.json", 1), (List{"error /volumes/0/series", "error /volumes/0/series"}))
        << "once, though two volumes show it";
    write("color.json", R"({"version": 1, "volumes": [{"series": "ocean.vdb", "surfaces": [{"iso": 20,
        "color": {"by": "series", "series": "changed.vdb", "range": [0, 30]}}]}]})");
    EXPECT_EQ(problems("color.json", 1), (List{"error /volumes/0/surfaces/0/color/series",
                                               "error /volumes/0/surfaces/0/color/series"}));
    write("lost.json", R"({"version": 1, "volumes": [{"series": "ocean.vdb", "surfaces": [{"iso": 20,
        "color": {"by": "series", "series": "none.vdb", "range": [0, 30]}}]}]})");
    EXPECT_EQ(problems("lost.json", 1), List{"error /volumes/0/surfaces/0/color/series"});
}

}  // namespace
}  // namespace isoglass::test
