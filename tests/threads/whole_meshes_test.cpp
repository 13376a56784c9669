#include "pipeline/render_loop.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <thread>

namespace isoglass {
namespace {

/// Seen from the scene's camera, one unit of the plane z = 0 is half the image's height.
constexpr glm::ivec2 kImageSize{128, 64};
/// Each half of the image shows a rectangle of (1..32) x (1..32) blocks of 2 x 2 pixels.
constexpr int kLevels = 32;
constexpr int kBlock = 2;
constexpr std::uint64_t kCodes = kLevels * kLevels;

/// A solid rectangle of many triangles: where some are missing it has a hole.
std::shared_ptr<const SurfaceMesh> rectangle(glm::vec2 low, glm::vec2 high) {
    constexpr int kCells = 16;
    SurfaceMesh mesh;
    for (int j = 0; j <= kCells; ++j) {
        for (int i = 0; i <= kCells; ++i) {
            const glm::vec2 at = low + (high - low) * glm::vec2(i, j) / static_cast<float>(kCells);
            mesh.positions.push_back({at, 0});
            mesh.normals.push_back({0, 0, 1});
        }
    }
    for (std::uint32_t j = 0; j < kCells; ++j) {
        for (std::uint32_t i = 0; i < kCells; ++i) {
            const std::uint32_t a = j * (kCells + 1) + i, b = a + 1, c = b + kCells + 1, d = c - 1;
            mesh.triangles.insert(mesh.triangles.end(), {a, b, c, a, c, d});
        }
    }
    return std::make_shared<const SurfaceMesh>(std::move(mesh));
}

/// Set number n: two volumes with a surface each, one a half of the image, whose sizes say n.
FrameMeshes makeSet(std::uint64_t number) {
    const auto code = static_cast<int>(number % kCodes);
    const glm::vec2 size =
        glm::vec2(code % kLevels + 1, code / kLevels + 1) / static_cast<float>(kLevels) * 2.0f;
    FrameMeshes set;
    set.request.number = number;
    for (std::size_t half = 0; half < 2; ++half) {
        const glm::vec2 low(half == 0 ? -2 : 0, -1);
        set.meshes.surfaces.push_back({half, 0, rectangle(low, low + size), {}});
    }
    return set;
}

Scene twoHalves() {
    Scene scene;
    for (const LinearColor color : {LinearColor(1, 0, 0), LinearColor(0, 1, 0)}) {
        Surface surface;
        surface.color = color;
        scene.volumes.emplace_back().surfaces = {surface};
    }
    scene.camera.up = {0, 1, 0};
    scene.camera.pose = {.eye = {0, 0, 1 / std::tan(scene.camera.fovDegrees * M_PI / 360)},
                         .target = {0, 0, 0}};
    scene.image.size = kImageSize;
    scene.image.background = LinearColor(0);
    scene.lighting = {.ambient = 1, .diffuse = 0, .specular = 0, .shininess = 1};
    return scene;
}

/// The code that one half of the image shows; -1 where it is not one solid rectangle in its corner.
int shownCode(const Image& image, int half) {
    const Rgba8 color = half == 0 ? Rgba8{255, 0, 0, 255} : Rgba8{0, 255, 0, 255};
    const int left = half * image.size.x / 2;
    const auto set = [&](int x, int y) { return image.at(left + x, image.size.y - 1 - y) == color; };
    int width = 0, height = 0;
    while (width < image.size.x / 2 && set(width, 0)) ++width;
    while (height < image.size.y && set(0, height)) ++height;
    for (int y = 0; y < image.size.y; ++y) {
        for (int x = 0; x < image.size.x / 2; ++x) {
            if (set(x, y) != (x < width && y < height)) return -1;
        }
    }
    if (width == 0 || width % kBlock != 0 || height % kBlock != 0) return -1;
    return (height / kBlock - 1) * kLevels + width / kBlock - 1;
}

TEST(WholeMeshes, ShownCodeSeesTornAndHalfUploadedPictures) {
    Image image{.size = kImageSize, .pixels = std::vector<Rgba8>(128 * 64, Rgba8{0, 0, 0, 255})};
    EXPECT_EQ(shownCode(image, 0), -1) << "nothing is shown";
    const auto fill = [&image](int left, int width, int height, Rgba8 color) {
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) image.at(left + x, 63 - y) = color;
        }
    };
    fill(0, 4, 2, {255, 0, 0, 255});
    fill(64, 6, 2, {0, 255, 0, 255});
    EXPECT_EQ(shownCode(image, 0), 1);
    EXPECT_EQ(shownCode(image, 1), 2);
    image.at(1, 63) = {0, 0, 0, 255};
    EXPECT_EQ(shownCode(image, 0), -1) << "a hole";
}

/// A worker publishes sets as fast as it can; every picture must show one whole set, never an older one.
TEST(WholeMeshes, NoFrameMixesTwoSetsOrShowsPartOfOne) {
    constexpr std::uint64_t kFrames = 300;
    RenderInbox inbox;
    inbox.meshes.post(makeSet(1));
    std::set<std::uint64_t> seen;
    std::uint64_t newest = 0;
    RenderLoop::Hooks hooks;
    hooks.present = [&](const ShownFrame& shown, Renderer& renderer) {
        const Image image = renderer.readSrgb();
        const std::uint64_t number = shown.meshes->request.number;
        EXPECT_GE(number, newest) << "frame " << shown.count << " goes back";
        newest = number;
        seen.insert(number);
        for (int half = 0; half < 2; ++half) {
            EXPECT_EQ(shownCode(image, half), static_cast<int>(number % kCodes))
                << "frame " << shown.count << ", half " << half << ", set " << number;
        }
        return shown.count + 1 < kFrames && !testing::Test::HasFailure();
    };
    RenderLoop loop(twoHalves(), Pace::newest, inbox, std::move(hooks));
    std::jthread worker([&](std::stop_token stop) {
        for (std::uint64_t number = 2; !stop.stop_requested(); ++number) inbox.meshes.post(makeSet(number));
    });
    loop.join();
    EXPECT_GE(seen.size(), 10u) << "the meshes hardly ever changed, so nothing could be torn";
}

}  // namespace
}  // namespace isoglass
