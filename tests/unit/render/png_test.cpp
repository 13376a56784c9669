#include "base/error.h"
#include "render/png_file.h"
#include "support/file_size_limit.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

namespace isoglass {
namespace {

/// A folder of the test's own, removed at the end.
class PngTest : public testing::Test {
  protected:
    std::filesystem::path folder_ =
        std::filesystem::temp_directory_path() / ("isoglass-png-" + std::to_string(::getpid()));

    void SetUp() override { std::filesystem::create_directories(folder_); }
    void TearDown() override { std::filesystem::remove_all(folder_); }

    std::ptrdiff_t fileCount() const {
        return std::distance(std::filesystem::directory_iterator(folder_), {});
    }
};

/// No two pixels alike, no symmetry, and too irregular to compress.
Image noise(int width, int height) {
    Image image{{width, height}, {}};
    std::uint32_t state = 1;
    const auto next = [&state] {
        return static_cast<std::uint8_t>((state = state * 1664525u + 1013904223u) >> 24);
    };
    for (int i = 0; i < width * height; ++i) image.pixels.push_back({next(), next(), next(), next()});
    return image;
}

TEST_F(PngTest, PixelsComeBackAsTheyWereWritten) {
    const Image image = noise(7, 5);
    writePng(folder_ / "a.png", image);
    const Image back = readPng(folder_ / "a.png");
    EXPECT_EQ(back.size, image.size);
    EXPECT_EQ(back.pixels, image.pixels);
    EXPECT_EQ(fileCount(), 1);
}

TEST_F(PngTest, AFullDiskIsAnErrorAndTheOlderFileStays) {
    const Image old = noise(3, 2);
    writePng(folder_ / "a.png", old);
    {
        // 64 x 64 pixels of noise are about 16 KiB.
        const FileSizeLimit limit(4096);
        EXPECT_THROW(writePng(folder_ / "a.png", noise(64, 64)), Error);
    }
    EXPECT_EQ(readPng(folder_ / "a.png").pixels, old.pixels);
    EXPECT_EQ(fileCount(), 1) << "the temporary file was left behind";
}

TEST_F(PngTest, ADeviceIsWrittenAsItIs) {
    EXPECT_THROW(writePng("/dev/full", noise(64, 64)), Error);
    EXPECT_TRUE(std::filesystem::is_character_file("/dev/full"));
    EXPECT_NO_THROW(writePng("/dev/null", noise(3, 2)));
    EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
}

TEST_F(PngTest, AMissingFolderIsAnError) {
    EXPECT_THROW(writePng(folder_ / "none" / "a.png", noise(2, 2)), Error);
}

TEST_F(PngTest, ADamagedFileIsAnErrorThatNamesIt) {
    writePng(folder_ / "a.png", noise(64, 64));
    std::filesystem::resize_file(folder_ / "a.png", 1000);
    try {
        readPng(folder_ / "a.png");
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.where(), (folder_ / "a.png").string());
    }
    EXPECT_THROW(readPng(folder_ / "none.png"), Error);
}

}  // namespace
}  // namespace isoglass
