#include "app/app_test.h"

#include <ostream>

namespace isoglass::test {
namespace {

constexpr int kFailure = 1;
constexpr int kWrongUsage = 2;

struct WrongInput {
    const char* claim;
    int status;
    std::vector<std::string> arguments;
    /// What the message must name: the place.
    const char* place;
};

const std::string kExcerpt = ISOGLASS_DATA_FOLDER "/ocean_excerpt.nc";

const std::vector<WrongInput> kWrongInputs = {
    {"NoVerb", kWrongUsage, {}, "command line"},
    {"UnknownVerb", kWrongUsage, {"paint"}, "paint"},
    {"UnknownOption", kWrongUsage, {"info", "ocean.vdb", "--colour"}, "--colour"},
    {"ImportWithoutOutput", kWrongUsage, {"import", kExcerpt}, "--output"},
    {"MeshWithoutIso", kWrongUsage, {"mesh", "ocean.vdb", "-o", "new.ply"}, "--iso"},
    {"IsoIsNoNumber", kWrongUsage, {"mesh", "ocean.vdb", "--iso", "warm", "-o", "new.ply"}, "--iso"},
    {"FramesIsNoRange", kWrongUsage, {"render", "scene.json", "-o", "new.png", "--frames", "3"}, "A:B"},
    {"FramesIsNoNumber", kWrongUsage, {"render", "scene.json", "-o", "new.png", "--frames", "a:b"}, "A:B"},
    {"SizeIsNoSize", kWrongUsage, {"render", "scene.json", "-o", "new.png", "--size", "12"}, "WxH"},
    {"UnknownMethod", kWrongUsage, {"render", "scene.json", "-o", "new.png", "--method", "5-pass"}, "5-pass"},
    {"NoThreads", kWrongUsage, {"info", "ocean.vdb", "--threads", "0"}, "--threads"},
    {"MemoryIsNoSize", kWrongUsage, {"info", "ocean.vdb", "--memory", "lots"}, "--memory"},
    {"KeepIsNoRange", kWrongUsage, {"import", kExcerpt, "-o", "new.vdb", "--keep", "20:10"}, "--keep"},

    {"FramesOutsideTheScene",
     kFailure,
     {"render", "scene.json", "-o", "f-{frame}.png", "--frames", "5:10"},
     "--frames"},
    {"FramesBackwards",
     kFailure,
     {"render", "scene.json", "-o", "f-{frame}.png", "--frames", "4:2"},
     "--frames"},
    {"ManyFramesInOneStill",
     kFailure,
     {"render", "scene.json", "-o", "new.png", "--frames", "2:4"},
     "new.png"},
    {"SizeOfNothing", kFailure, {"render", "scene.json", "-o", "new.png", "--size", "0x4"}, "--size"},
    {"MemoryTooSmall", kFailure, {"render", "scene.json", "-o", "new.png", "--memory", "1kB"}, "ocean.vdb"},
    {"MissingSeries", kFailure, {"info", "absent.vdb"}, "absent.vdb"},
    {"MissingSource", kFailure, {"import", "absent.nc", "-o", "new.vdb"}, "absent.nc"},
    {"MissingScene", kFailure, {"render", "absent.json", "-o", "new.png"}, "absent.json"},
    {"MissingSceneToPlan", kFailure, {"plan", "absent.json"}, "absent.json"},
    {"SceneWithoutItsSeries", kFailure, {"render", "lost.json", "-o", "new.png"}, "absent.vdb"},
    {"UnknownKeyInScene", kFailure, {"render", "unknown.json", "-o", "new.png"}, "unknown.json"},
    {"SceneIsNoJson", kFailure, {"plan", "text.json"}, "text.json"},
    {"RenderOfASeries", kFailure, {"render", "ocean.vdb", "-o", "new.png"}, "ocean.vdb"},
    {"NotASeries", kFailure, {"info", "scene.json"}, "scene.json"},
    {"MeshOfNoSeries", kFailure, {"mesh", "scene.json", "--iso", "1", "-o", "new.ply"}, "scene.json"},
    {"ImportOfNoSource", kFailure, {"import", "scene.json", "-o", "new.vdb"}, "scene.json"},
    {"ImportOfAFolder", kFailure, {"import", ".", "-o", "new.vdb"}, "."},
    {"UnknownVariable", kFailure, {"import", kExcerpt, "-o", "new.vdb", "--variable", "SALT"}, "SALT"},
    {"TimesDoNotMatch", kFailure, {"import", kExcerpt, "-o", "new.vdb", "--times", "1,2"}, "--times"},
    {"ImportToAWrongExtension", kFailure, {"import", kExcerpt, "-o", "new.nc"}, "new.nc"},
    {"MeshToAWrongExtension", kFailure, {"mesh", "ocean.vdb", "--iso", "15", "-o", "new.xyz"}, "new.xyz"},
    {"RenderToAWrongExtension", kFailure, {"render", "scene.json", "-o", "new.gif"}, "new.gif"},
    {"ImportToAMissingFolder", kFailure, {"import", kExcerpt, "-o", "no/new.vdb"}, "no"},
    {"MeshToAMissingFolder", kFailure, {"mesh", "ocean.vdb", "--iso", "15", "-o", "no/new.ply"}, "no"},
    {"StillToAMissingFolder", kFailure, {"render", "scene.json", "-o", "no/new.png"}, "no"},
    {"SequenceToAMissingFolder", kFailure, {"render", "scene.json", "-o", "no/f-{frame}.png"}, "no"},
    {"VideoToAMissingFolder", kFailure, {"render", "scene.json", "-o", "no/new.mp4"}, "no"},
    {"UnknownBenchmark", kFailure, {"bench", "teapot"}, "teapot"},
};

void PrintTo(const WrongInput& input, std::ostream* out) {
    *out << "isoglass";
    for (const std::string& argument : input.arguments) *out << ' ' << argument;
}

class WrongInputs : public AppTest, public testing::WithParamInterface<WrongInput> {
  protected:
    void SetUp() override {
        importOcean();
        writeScene();
        writeScene(R"("tansparency": {"method": "auto"},)", "unknown.json");
        std::ofstream(folder_ / "text.json") << "not JSON";
        std::ofstream(folder_ / "lost.json")
            << R"({"version": 1, "volumes": [{"name": "a", "series": "absent.vdb", "surfaces": [{"iso": 1}]}]})";
    }
};

TEST_P(WrongInputs, AreReportedOnStandardErrorAndLeaveNothingBehind) {
    const WrongInput& input = GetParam();
    const auto before = files();
    const RunResult result = isoglass(input.arguments);
    EXPECT_EQ(result.status, input.status);
    EXPECT_EQ(result.out, "");
    // Notes may come before it.
    EXPECT_TRUE(contains("\n" + result.err, "\nisoglass: error: ")) << result.err;
    EXPECT_TRUE(contains(result.err, input.place)) << input.place << " is not in: " << result.err;
    EXPECT_FALSE(contains(result.err, "\x1b")) << result.err;
    EXPECT_EQ(files(), before);
}

INSTANTIATE_TEST_SUITE_P(, WrongInputs, testing::ValuesIn(kWrongInputs),
                         [](const auto& input) { return std::string(input.param.claim); });

class CommandLine : public AppTest {};

TEST_F(CommandLine, UnknownSceneKeyNamesTheClosestKnownOne) {
    writeScene(R"("tansparency": {"method": "auto"},)");
    EXPECT_TRUE(contains(isoglass({"plan", "scene.json"}).err, "transparency"));
}

TEST_F(CommandLine, HelpOfEveryVerbIsData) {
    for (const char* verb : {"", "import", "export", "info", "render", "mesh", "validate", "plan", "bench"}) {
        std::vector<std::string> arguments = {"--help"};
        if (*verb) arguments.insert(arguments.begin(), verb);
        const RunResult result = run(arguments);
        EXPECT_FALSE(result.out.empty()) << verb;
        EXPECT_EQ(result.err, "") << verb;
    }
}

TEST_F(CommandLine, VersionIsData) {
    EXPECT_TRUE(run({"--version"}).out.starts_with("isoglass "));
}

}  // namespace
}  // namespace isoglass::test
