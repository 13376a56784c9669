#include "app/app_test.h"
#include "render/png_file.h"

namespace isoglass::test {
namespace {

class Render : public AppTest {
  protected:
    void SetUp() override {
        importOcean();
        writeScene();
    }

    Image picture(const std::string& name) const { return readPng(folder_ / name); }
};

TEST_F(Render, StillShowsTheScene) {
    run({"render", "scene.json", "-o", "still.png"});
    const Image image = picture("still.png");
    EXPECT_EQ(image.size, glm::ivec2(96, 64));
    std::set<std::uint32_t> colors;
    for (const Rgba8 p : image.pixels) colors.insert(p.r | p.g << 8 | p.b << 16);
    EXPECT_GT(colors.size(), 100u) << "hardly anything is shown";
    EXPECT_EQ(files(), (std::set<std::string>{"ocean.vdb", "scene.json", "still.png"}));
}

TEST_F(Render, SizeOverridesTheScene) {
    run({"render", "scene.json", "-o", "still.png", "--size", "33x17"});
    EXPECT_EQ(picture("still.png").size, glm::ivec2(33, 17));
}

TEST_F(Render, CameraPathMovesTheCamera) {
    writeScene(R"("lighting": {},)", "still.json");
    const std::string scene = bytesOf("still.json");
    const std::string eye = R"("eye": [150, -400, 165],)";
    std::string moving = scene;
    moving.replace(
        moving.find(eye), eye.size(),
        eye + R"("path": [{"at": 0, "eye": [150, -400, 165]}, {"at": 0.36, "eye": [285, -390, 165]}],)");
    std::string arrived = scene;
    arrived.replace(arrived.find(eye), eye.size(), R"("eye": [285, -390, 165],)");
    std::ofstream(folder_ / "moving.json") << moving;
    std::ofstream(folder_ / "arrived.json") << arrived;
    const auto picture = [&](const std::string& name, int frame) {
        const std::string frames = std::to_string(frame) + ":" + std::to_string(frame);
        run({"render", name + ".json", "-o", name + ".png", "--frames", frames});
        return bytesOf(name + ".png");
    };
    EXPECT_EQ(picture("moving", 0), picture("still", 0)) << "the first key is at 0";
    EXPECT_EQ(picture("moving", 9), picture("arrived", 9)) << "the last key is at frame 9 of 25 a second";
    EXPECT_NE(picture("moving", 5), picture("still", 5));
    EXPECT_NE(picture("moving", 5), picture("arrived", 5));
}

TEST_F(Render, TransparentBackgroundIsSeenThrough) {
    writeScene(R"("transparency": {"method": "3-pass"},)", "glass.json");
    std::string scene = bytesOf("glass.json");
    scene.replace(scene.find("[96, 64]"), 8, R"([96, 64], "background": "transparent")");
    std::ofstream(folder_ / "glass.json") << scene;
    run({"render", "glass.json", "-o", "glass.png"});
    std::set<int> alphas;
    for (const Rgba8 p : picture("glass.png").pixels) alphas.insert(p.a);
    EXPECT_TRUE(alphas.contains(0)) << "beside the ocean";
    EXPECT_TRUE(alphas.contains(255)) << "on the opaque surface";
    EXPECT_TRUE(alphas.contains(76) || alphas.contains(77)) << "76.5: through one surface of opacity 0.3";
    EXPECT_TRUE(alphas.contains(102)) << "through one surface of opacity 0.4";
}

TEST_F(Render, SequenceHasExactlyTheFramesAskedFor) {
    std::filesystem::create_directory(folder_ / "out");
    run({"render", "scene.json", "-o", "out/f-{frame}.png", "--frames", "2:4"});
    std::set<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder_ / "out")) {
        names.insert(entry.path().filename().string());
    }
    EXPECT_EQ(names, (std::set<std::string>{"f-00002.png", "f-00003.png", "f-00004.png"}));
    run({"render", "scene.json", "-o", "three.png", "--frames", "3:3"});
    EXPECT_EQ(bytesOf("three.png"), bytesOf("out/f-00003.png"));
    EXPECT_NE(bytesOf("out/f-00002.png"), bytesOf("out/f-00003.png"));
}

TEST_F(Render, VideoHoldsEveryFrame) {
    run({"render", "scene.json", "-o", "film.mp4"});
    EXPECT_EQ(bytesOf("film.mp4").substr(4, 4), "ftyp");
    EXPECT_EQ(files(), (std::set<std::string>{"film.mp4", "ocean.vdb", "scene.json"}));
    const RunResult probe =
        runProgram("/usr/bin/env",
                   {"ffprobe", "-v", "error", "-count_frames", "-show_entries",
                    "stream=width,height,r_frame_rate,nb_read_frames", "-of", "csv=p=0", "film.mp4"},
                   {.folder = folder_.path()});
    ASSERT_EQ(probe.status, 0) << "ffprobe comes with ffmpeg: " << probe.err;
    EXPECT_EQ(probe.out, "96,64,25/1,10\n");
}

TEST_F(Render, VideoIsTheSameInASecondRun) {
    run({"render", "scene.json", "-o", "a.mp4", "--frames", "0:4"});
    run({"render", "scene.json", "-o", "b.mp4", "--frames", "0:4", "--threads", "1"});
    EXPECT_EQ(bytesOf("a.mp4"), bytesOf("b.mp4"));
}

TEST_F(Render, PictureIsTheSameInASecondRunAndForAnyNumberOfThreads) {
    run({"render", "scene.json", "-o", "a.png", "--frames", "3:3"});
    run({"render", "scene.json", "-o", "b.png", "--frames", "3:3"});
    run({"render", "scene.json", "-o", "c.png", "--frames", "3:3", "--threads", "1"});
    EXPECT_EQ(bytesOf("a.png"), bytesOf("b.png"));
    EXPECT_EQ(bytesOf("a.png"), bytesOf("c.png"));
}

TEST_F(Render, MethodsDiffer) {
    run({"render", "scene.json", "-o", "three.png", "--method", "3-pass"});
    run({"render", "scene.json", "-o", "four.png", "--method", "4-pass"});
    run({"render", "scene.json", "-o", "auto.png", "--method", "auto"});
    EXPECT_NE(bytesOf("three.png"), bytesOf("four.png"));
    EXPECT_EQ(bytesOf("auto.png"), bytesOf("four.png")) << "overlapping closed surfaces need 4-pass";
}

TEST_F(Render, ProgressIsRedrawnOnATerminalAloneAndNotWithNoColor) {
    for (const bool terminal : {false, true}) {
        if (terminal && !canMakeTerminal()) GTEST_SKIP() << "this system makes no terminals";
        for (const bool noColor : {false, true}) {
            RunOptions options;
            options.errIsTerminal = terminal;
            if (noColor) options.environment = {"NO_COLOR=1"};
            const RunResult result = run({"render", "scene.json", "-o", "f-{frame}.png"}, options);
            EXPECT_TRUE(contains(result.err, "rendering 10/10 frames")) << result.err;
            EXPECT_EQ(contains(result.err, "\x1b"), terminal && !noColor) << result.err;
            EXPECT_EQ(result.out, "");
        }
    }
}

}  // namespace
}  // namespace isoglass::test
