#include "app/stop_test.h"

#include "render/png_file.h"

#include <csignal>

namespace isoglass::test {
namespace {

using Stop = StopTest;

/// More frames than are drawn between a look at the folder and the signal that follows it.
constexpr const char* kLongScene = R"("time": {"from": "0000-01-16T06:00:00", "to": "0001-01-15T11:49:12",
                                              "duration": 40, "fps": 25})";

/// scene.json with a thousand frames.
void writeLongScene(const std::filesystem::path& folder) {
    std::ofstream(folder / "scene.json")
        << R"({"version": 1, "volumes": [{"series": "ocean.vdb", "place": {"scale": [1, 1, 0.18]},
               "surfaces": [{"iso": 25}, {"iso": 10, "opacity": 0.3}]}],
               "camera": {"eye": [150, -400, 165], "target": [203, -6, -52], "fov": 28.5},
               "image": {"size": [96, 64]}, )"
        << kLongScene << "}";
}

/// Processes whose working directory is the folder.
std::size_t processesIn(const std::filesystem::path& folder) {
    std::size_t count = 0;
    std::error_code ignored;
    for (const auto& entry : std::filesystem::directory_iterator("/proc", ignored)) {
        const auto at = std::filesystem::read_symlink(entry.path() / "cwd", ignored);
        count += !ignored && at == std::filesystem::canonical(folder);
    }
    return count;
}

TEST_F(Stop, SequenceKeepsWholeFramesAndSaysHowToGoOn) {
    writeLongScene(folder_.path());
    for (const auto& [signal, status] : {std::pair(SIGINT, 130), std::pair(SIGTERM, 143)}) {
        const std::string prefix = std::to_string(signal) + "-";
        StartedProgram program = start({"render", "scene.json", "-o", prefix + "{frame}.png"});
        ASSERT_TRUE(eventually([&] { return exists(prefix + "00001.png"); }));
        program.signal(signal);
        const RunResult result = program.finish();
        EXPECT_EQ(result.status, status) << result.err;
        EXPECT_TRUE(contains(result.err, "isoglass: stopped: ")) << result.err;
        EXPECT_TRUE(contains(result.err, " of 1000 frames are there")) << result.err;
        EXPECT_FALSE(contains(result.err, "isoglass: error: ")) << result.err;
        EXPECT_FALSE(anyFile(isPart));
        EXPECT_TRUE(exists(prefix + "0-999.unfinished"));
        int pictures = 0;
        for (const std::string& name : files()) {
            if (!name.ends_with(".png") || !name.starts_with(prefix)) continue;
            EXPECT_EQ(readPng(folder_ / name).size, glm::ivec2(96, 64)) << name;
            ++pictures;
        }
        EXPECT_TRUE(contains(result.err, std::to_string(pictures) + " of 1000 frames")) << result.err;
    }
}

TEST_F(Stop, VideoLeavesNothingAndNoEncoder) {
    writeLongScene(folder_.path());
    const auto before = files();
    StartedProgram program = start({"render", "scene.json", "-o", "film.mp4"});
    ASSERT_TRUE(eventually([&] { return processesIn(folder_.path()) == 2; }));
    program.signal(SIGINT);
    const RunResult result = program.finish();
    EXPECT_EQ(result.status, 130) << result.err;
    EXPECT_TRUE(contains(result.err, "isoglass: stopped\n")) << result.err;
    EXPECT_EQ(files(), before);
    EXPECT_EQ(processesIn(folder_.path()), 0u);
}

/// While the process is held, two signals gather: it sees both before it can end the frame.
TEST_F(Stop, SecondSignalEndsAtOnceAndStillLeavesNothing) {
    writeLongScene(folder_.path());
    const auto before = files();
    StartedProgram program = start({"render", "scene.json", "-o", "film.mp4"});
    ASSERT_TRUE(eventually([&] { return processesIn(folder_.path()) == 2; }));
    for (const int signal : {SIGSTOP, SIGINT, SIGTERM, SIGCONT}) program.signal(signal);
    const RunResult result = program.finish();
    EXPECT_TRUE(result.status == 130 || result.status == 143) << result.status;
    EXPECT_FALSE(contains(result.err, "isoglass: stopped")) << result.err;
    EXPECT_EQ(files(), before);
    EXPECT_EQ(processesIn(folder_.path()), 0u);
}

TEST_F(Stop, ImportLeavesNothing) {
    constexpr int kSide = 96;
    std::vector<std::string> arguments = {"import"};
    for (int i = 0; i < 30; ++i) {
        arguments.push_back("f" + std::to_string(i) + ".pvm");
        std::ofstream file(folder_ / arguments.back(), std::ios::binary);
        file << "PVM\n" << kSide << ' ' << kSide << ' ' << kSide << "\n1\n";
        std::string samples(kSide * kSide * kSide, '\0');
        for (std::size_t s = 0; s < samples.size(); ++s)
            samples[s] = static_cast<char>(s * 2654435761u >> 13);
        file << samples;
    }
    arguments.insert(arguments.end(), {"-o", "new.vdb"});
    const auto before = files();
    StartedProgram program = start(arguments);
    ASSERT_TRUE(eventually([&] { return anyFile(isPart); }));
    program.signal(SIGINT);
    EXPECT_EQ(program.finish().status, 130);
    EXPECT_EQ(files(), before);
}

TEST_F(Stop, TableOfASeriesLeavesNothing) {
    const auto before = files();
    StartedProgram program =
        start({"mesh", "ocean.vdb", "--iso", "15", "--series", "--steps", "100000", "-o", "new.csv"});
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    program.signal(SIGTERM);
    EXPECT_EQ(program.finish().status, 143);
    EXPECT_EQ(files(), before);
}

}  // namespace
}  // namespace isoglass::test
