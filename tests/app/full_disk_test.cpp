#include "app/app_test.h"

namespace isoglass::test {
namespace {

class FullDisk : public AppTest {
  protected:
    void SetUp() override {
        importOcean();
        writeScene();
    }

    /// The command on a disk that takes no file beyond `bytes`, with an older file in the way.
    void expectNothingLeft(std::vector<std::string> arguments, const std::string& out, std::uint64_t bytes) {
        std::ofstream(folder_ / out) << "older";
        arguments.insert(arguments.end(), {"-o", out});
        const auto before = files();
        const RunResult result = isoglass(arguments, {.fileSizeLimit = bytes});
        EXPECT_EQ(result.status, 1) << out << " with " << bytes << " bytes: " << result.err;
        EXPECT_TRUE(contains(result.err, "isoglass: error: ")) << result.err;
        EXPECT_TRUE(contains(result.err, out)) << result.err;
        EXPECT_EQ(files(), before) << out << " with " << bytes << " bytes";
        EXPECT_EQ(bytesOf(out), "older");
    }
};

// Each output is larger than the largest limit here; the first write fails, or a later one.

TEST_F(FullDisk, ImportLeavesNothingBehind) {
    for (const std::uint64_t bytes : {0, 1000, 100'000}) {
        expectNothingLeft({"import", ISOGLASS_DATA_FOLDER "/ocean_excerpt.nc"}, "new.vdb", bytes);
    }
}

TEST_F(FullDisk, MeshLeavesNothingBehind) {
    for (const char* out : {"new.ply", "new.obj", "new.stl", "new.off"}) {
        for (const std::uint64_t bytes : {0, 1000, 20'000}) {
            expectNothingLeft({"mesh", "ocean.vdb", "--iso", "15"}, out, bytes);
        }
    }
}

TEST_F(FullDisk, TableLeavesNothingBehind) {
    for (const std::uint64_t bytes : {0, 100}) {
        expectNothingLeft({"mesh", "ocean.vdb", "--iso", "15", "--series"}, "new.csv", bytes);
    }
}

TEST_F(FullDisk, StillLeavesNothingBehind) {
    for (const std::uint64_t bytes : {0, 1000}) expectNothingLeft({"render", "scene.json"}, "new.png", bytes);
}

TEST_F(FullDisk, VideoLeavesNothingBehind) {
    for (const std::uint64_t bytes : {0, 1000, 4000}) {
        expectNothingLeft({"render", "scene.json"}, "new.mp4", bytes);
    }
}

TEST_F(FullDisk, SequenceKeepsWholePicturesOnly) {
    run({"render", "scene.json", "-o", "whole.png"});
    const auto before = files();
    const RunResult result =
        isoglass({"render", "scene.json", "-o", "f-{frame}.png"}, {.fileSizeLimit = 1000});
    EXPECT_EQ(result.status, 1);
    EXPECT_EQ(files(), before);
}

TEST_F(FullDisk, VideoWithoutFfmpegLeavesNothingBehind) {
    const auto before = files();
    const RunResult result =
        isoglass({"render", "scene.json", "-o", "new.mp4"}, {.environment = {"PATH=/nowhere"}});
    EXPECT_EQ(result.status, 1);
    EXPECT_TRUE(contains(result.err, "cannot run ffmpeg")) << result.err;
    EXPECT_EQ(files(), before);
}

}  // namespace
}  // namespace isoglass::test
