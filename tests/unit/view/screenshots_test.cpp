#include "app/view/screenshots.h"

#include "basis/bounded_queue.h"
#include "render/png_file.h"
#include "unit/mesh_io/scratch_folder.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <set>

namespace isoglass {
namespace {

class ScreenshotsTest : public testing::Test {
  protected:
    ScratchFolder folder_;
    std::filesystem::path before_ = std::filesystem::current_path();

    ScreenshotsTest() { std::filesystem::current_path(folder_.path()); }
    ~ScreenshotsTest() override { std::filesystem::current_path(before_); }
};

TEST_F(ScreenshotsTest, EveryPictureGetsAFileOfItsOwn) {
    BoundedQueue<Screenshots::Outcome> outcomes(8);
    const Image image{{2, 1}, {{255, 0, 0, 255}, {0, 0, 255, 255}}};
    {
        Screenshots screenshots([&](const Screenshots::Outcome& outcome) { outcomes.push(outcome); });
        for (int i = 0; i < 4; ++i) screenshots.save(image, "storm");
    }
    std::set<std::filesystem::path> files;
    for (int i = 0; i < 4; ++i) {
        const auto outcome = outcomes.pop();
        EXPECT_EQ(outcome->error, "");
        EXPECT_EQ(readPng(outcome->file).pixels, image.pixels);
        files.insert(outcome->file);
    }
    EXPECT_EQ(files.size(), 4u);
}

TEST_F(ScreenshotsTest, NameSaysTheTimeAndNeverOverwrites) {
    const std::filesystem::path first = screenshotFile("a", 0);
    EXPECT_TRUE(first.string().starts_with("a-19")) << first;
    std::ofstream(first) << "taken";
    const std::filesystem::path second = screenshotFile("a", 0);
    EXPECT_EQ(second.string(), first.stem().string() + "-2.png");
}

TEST_F(ScreenshotsTest, NameStaysInTheFolder) {
    EXPECT_FALSE(screenshotFile("../../etc/x", 0).has_parent_path());
}

TEST_F(ScreenshotsTest, AFailureIsReported) {
    std::filesystem::remove_all(folder_.path());
    BoundedQueue<Screenshots::Outcome> outcomes(1);
    Screenshots screenshots([&](const Screenshots::Outcome& outcome) { outcomes.push(outcome); });
    screenshots.save({{1, 1}, {{0, 0, 0, 255}}}, "a");
    EXPECT_NE(outcomes.pop()->error, "");
}

}  // namespace
}  // namespace isoglass
