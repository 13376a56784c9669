#include "app/stop_test.h"

#include <csignal>
#include <sstream>

namespace isoglass::test {
namespace {

class Resume : public StopTest {
  protected:
    static constexpr int kFrames = 10;

    static std::string frameName(int frame) { return "0000" + std::to_string(frame) + ".png"; }

    /// Frames of one run without a stop, in "whole-".
    void renderWhole(const std::string& scene = "scene.json") const {
        run({"render", scene, "-o", "whole-{frame}.png"});
    }

    /// A run that ends after some frames but before the last one, in "part-". Frames are written in order.
    void renderPart() {
        for (int attempt = 0; attempt < 20; ++attempt) {
            for (int frame = 0; frame < kFrames; ++frame)
                std::filesystem::remove(folder_ / ("part-" + frameName(frame)));
            StartedProgram program = start({"render", "scene.json", "-o", "part-{frame}.png"});
            ASSERT_TRUE(eventually([&] { return exists("part-" + frameName(1)); }));
            program.signal(SIGINT);
            if (program.finish().status == 130) return;
            // Else it was faster than the signal.
        }
        FAIL() << "never stopped in time";
    }

    int countOfPart() const {
        int count = 0;
        for (const std::string& name : files()) count += name.starts_with("part-") && name.ends_with(".png");
        return count;
    }

    RunResult goOn(const std::string& scene = "scene.json") const {
        return run({"render", scene, "-o", "part-{frame}.png"});
    }

    void expectSameAsWhole() const {
        for (int frame = 0; frame < kFrames; ++frame) {
            EXPECT_EQ(bytesOf("part-" + frameName(frame)), bytesOf("whole-" + frameName(frame))) << frame;
        }
        EXPECT_FALSE(anyFile([](const std::string& name) { return name.ends_with(".unfinished"); }));
    }
};

TEST_F(Resume, GivesTheBytesOfARunWithoutAStopAndRendersOnlyWhatIsMissing) {
    renderWhole();
    renderPart();
    const int kept = countOfPart();
    const auto time = std::filesystem::last_write_time(folder_ / ("part-" + frameName(0)));
    const RunResult result = goOn();
    EXPECT_TRUE(contains(result.err, "note: " + std::to_string(kept) + " of 10 frames from an earlier run"))
        << result.err;
    const std::string missing = std::to_string(kFrames - kept);
    EXPECT_TRUE(contains(result.err, "rendering " + missing + "/" + missing)) << result.err;
    EXPECT_EQ(std::filesystem::last_write_time(folder_ / ("part-" + frameName(0))), time);
    expectSameAsWhole();
}

TEST_F(Resume, AFinishedSequenceIsRenderedAgain) {
    renderWhole();
    const RunResult result = run({"render", "scene.json", "-o", "whole-{frame}.png"});
    EXPECT_TRUE(contains(result.err, "rendering 10/10 frames")) << result.err;
}

TEST_F(Resume, DamagedAndMissingFramesAreRenderedAgain) {
    renderWhole();
    renderPart();
    const int there = countOfPart();
    const std::string first = bytesOf("part-" + frameName(0));
    std::ofstream(folder_ / ("part-" + frameName(0)), std::ios::binary) << first.substr(0, first.size() / 2);
    std::filesystem::remove(folder_ / ("part-" + frameName(1)));
    const RunResult result = goOn();
    const std::string missing = std::to_string(kFrames - there + 2);
    EXPECT_TRUE(contains(result.err, "rendering " + missing + "/" + missing)) << result.err;
    expectSameAsWhole();
}

/// What the frames depend on changes in between; none of them may stay.
TEST_F(Resume, FramesOfAnotherSceneSeriesOrSizeAreNeverMixedIn) {
    writeScene(R"("lighting": {"ambient": 0.5},)", "other.json");
    const auto expectAllAgain = [&](const std::string& scene, const std::string& what) {
        renderWhole(scene);
        const RunResult result = goOn(scene);
        EXPECT_TRUE(contains(result.err, "every frame is rendered")) << what << ": " << result.err;
        EXPECT_TRUE(contains(result.err, "rendering 10/10 frames")) << what << ": " << result.err;
        expectSameAsWhole();
    };
    renderPart();
    expectAllAgain("other.json", "another scene");
    renderPart();
    run({"import", ISOGLASS_DATA_FOLDER "/ocean_excerpt.nc", "-o", "ocean.vdb", "--tolerance", "0.5"});
    expectAllAgain("scene.json", "another series");
    renderPart();
    const RunResult result = run({"render", "scene.json", "-o", "part-{frame}.png", "--size", "48x32"});
    EXPECT_TRUE(contains(result.err, "rendering 10/10 frames")) << result.err;
}

TEST_F(Resume, TheSeriesThatColoursCounts) {
    const std::string excerpt = ISOGLASS_DATA_FOLDER "/ocean_excerpt.nc";
    run({"import", excerpt, "-o", "color.vdb"});
    std::string scene = bytesOf("scene.json");
    scene.replace(scene.find("\"#e04030\""), 9, R"({"by": "series", "series": "color.vdb", "range": [0, 30]})");
    std::ofstream(folder_ / "scene.json") << scene;
    renderPart();
    run({"import", excerpt, "--variable", "color = 30 - TEMP", "-o", "color.vdb"});
    renderWhole();
    const RunResult result = goOn();
    EXPECT_TRUE(contains(result.err, "every frame is rendered")) << result.err;
    expectSameAsWhole();
}

TEST_F(Resume, ThreadsAndMemoryDoNotCount) {
    renderPart();
    const RunResult result =
        run({"render", "scene.json", "-o", "part-{frame}.png", "--threads", "1", "--memory", "1GB"});
    EXPECT_TRUE(contains(result.err, "from an earlier run are kept")) << result.err;
}

/// A small scene with three segments of video.
void writeLongScene(const std::filesystem::path& file) {
    std::ofstream(file) << R"({"version": 1,
        "volumes": [{"series": "ocean.vdb", "place": {"scale": [1, 1, 0.18]}, "surfaces": [{"iso": 20}]}],
        "time": {"from": "0000-01-16T06:00:00", "to": "0001-01-15T11:49:12", "duration": 10, "fps": 30},
        "camera": {"eye": [150, -400, 165], "target": [203, -6, -52], "fov": 28.5},
        "image": {"size": [48, 32]}})";
}

TEST_F(Resume, VideoGoesOnFromWholeSegmentsAndHasTheBytesOfARunWithoutAStop) {
    writeLongScene(folder_ / "long.json");
    run({"render", "long.json", "-o", "whole.mp4"});
    const std::filesystem::path parts = folder_ / "part.0-299.unfinished";
    StartedProgram program = start({"render", "long.json", "-o", "part.mp4"});
    ASSERT_TRUE(eventually([&] { return std::filesystem::exists(parts / "journal"); }));
    program.signal(SIGINT);
    const RunResult stopped = program.finish();
    ASSERT_EQ(stopped.status, 130) << stopped.err;
    EXPECT_TRUE(contains(stopped.err, "of 300 frames are there")) << stopped.err;
    EXPECT_FALSE(exists("part.mp4"));
    const RunResult result = run({"render", "long.json", "-o", "part.mp4"});
    EXPECT_TRUE(contains(result.err, "120 of 300 frames from an earlier run are kept") ||
                contains(result.err, "240 of 300 frames from an earlier run are kept"))
        << result.err;
    EXPECT_EQ(bytesOf("part.mp4"), bytesOf("whole.mp4"));
    EXPECT_FALSE(std::filesystem::exists(parts));
}

TEST_F(Resume, SegmentsOfAVideoFollowEachOtherWithoutAGap) {
    writeLongScene(folder_ / "long.json");
    run({"render", "long.json", "-o", "whole.mp4"});
    const RunResult probe = runProgram(
        "/usr/bin/env",
        {"ffprobe", "-v", "error", "-show_entries", "frame=pts_time", "-of", "csv=p=0", "whole.mp4"},
        {.folder = folder_.path()});
    ASSERT_EQ(probe.status, 0) << probe.err;
    std::istringstream lines(probe.out);
    int count = 0;
    for (double time = 0; lines >> time; ++count) {
        lines.ignore(8, '\n');
        // ffprobe prints microseconds.
        EXPECT_NEAR(time, count / 30.0, 1e-6);
    }
    EXPECT_EQ(count, 300);
}

TEST_F(Resume, DamagedJournalMeansThatEveryFrameIsRendered) {
    renderWhole();
    renderPart();
    std::ofstream(folder_ / "part-0-9.unfinished") << "nonsense";
    EXPECT_TRUE(contains(goOn().err, "rendering 10/10 frames"));
    expectSameAsWhole();
}

}  // namespace
}  // namespace isoglass::test
