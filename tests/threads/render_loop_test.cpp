#include "pipeline/render_loop.h"

#include "base/error.h"
#include "pipeline/extraction_worker.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <latch>
#include <stdexcept>

namespace isoglass {
namespace {

/// A red square before black, seen from above.
Scene redSquare() {
    Scene scene;
    Surface surface;
    surface.color = {1, 0, 0};
    scene.volumes.emplace_back().surfaces = {surface};
    scene.camera.up = {0, 1, 0};
    scene.camera.pose = {.eye = {0, 0, 4}, .target = {0, 0, 0}};
    scene.image.size = {32, 32};
    scene.image.background = LinearColor(0);
    scene.lighting = {.ambient = 1, .diffuse = 0, .specular = 0, .shininess = 1};
    return scene;
}

constexpr Rgba8 kRed{255, 0, 0, 255};
constexpr Rgba8 kBlack{0, 0, 0, 255};

SceneMeshes squareMeshes() {
    auto mesh = std::make_shared<SurfaceMesh>();
    mesh->positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
    mesh->normals.assign(4, {0, 0, 1});
    mesh->triangles = {0, 1, 2, 0, 2, 3};
    SceneMeshes meshes;
    meshes.surfaces.push_back({0, 0, std::move(mesh), {}});
    return meshes;
}

FrameMeshes squareSet() {
    FrameMeshes set;
    set.meshes = squareMeshes();
    return set;
}

Rgba8 middle(const Image& image) {
    return image.at(image.size.x / 2, image.size.y / 2);
}

TEST(RenderLoop, PresentsHundredFramesWhileExtractionIsHeldAndTheMeshesAfterwards) {
    constexpr std::uint64_t kFrames = 100;
    std::latch started(1), released(1);
    Mailbox<FrameMeshes> meshes;
    Mailbox<CameraPose> cameras;
    std::uint64_t presentedWhileHeld = 0;
    Rgba8 before{}, after{};
    ExtractionWorker worker(
        [&](const FrameRequest&) {
            started.count_down();
            released.wait();
            return squareMeshes();
        },
        meshes);
    worker.request({});
    started.wait();
    RenderLoop::Hooks hooks;
    hooks.present = [&](const ShownFrame& shown, Renderer& renderer) {
        if (shown.meshes) {
            after = middle(renderer.readSrgb());
            return false;
        }
        if (shown.count < kFrames) {
            before = middle(renderer.readSrgb());
            if (++presentedWhileHeld == kFrames) released.count_down();
        }
        return true;
    };
    RenderLoop(redSquare(), Pace::newest, meshes, cameras, std::move(hooks)).join();
    EXPECT_EQ(presentedWhileHeld, kFrames);
    EXPECT_EQ(before, kBlack);
    EXPECT_EQ(after, kRed);
}

TEST(RenderLoop, KeepsShowingTheOldMeshesWhileNewOnesAreMade) {
    Mailbox<FrameMeshes> meshes;
    Mailbox<CameraPose> cameras;
    meshes.post(squareSet());
    RenderLoop::Hooks hooks;
    hooks.present = [&](const ShownFrame& shown, Renderer& renderer) {
        EXPECT_EQ(middle(renderer.readSrgb()), kRed) << "frame " << shown.count;
        return shown.count < 20;
    };
    RenderLoop(redSquare(), Pace::newest, meshes, cameras, std::move(hooks)).join();
}

TEST(RenderLoop, OldMeshesAreFreed) {
    Mailbox<FrameMeshes> meshes;
    Mailbox<CameraPose> cameras;
    RenderLoop::Hooks hooks;
    hooks.present = [&](const ShownFrame& shown, Renderer& renderer) {
        EXPECT_EQ(renderer.meshes().count(), shown.meshes ? 1u : 0u) << "frame " << shown.count;
        meshes.post(squareSet());
        return shown.count < 20;
    };
    RenderLoop(redSquare(), Pace::newest, meshes, cameras, std::move(hooks)).join();
}

TEST(RenderLoop, FollowsTheNewestCameraWithoutNewMeshes) {
    Mailbox<FrameMeshes> meshes;
    Mailbox<CameraPose> cameras;
    meshes.post(squareSet());
    RenderLoop::Hooks hooks;
    hooks.present = [&](const ShownFrame& shown, Renderer& renderer) {
        // From frame 2 on the camera looks past the square.
        EXPECT_EQ(middle(renderer.readSrgb()), shown.count < 2 ? kRed : kBlack) << "frame " << shown.count;
        if (shown.count == 1) cameras.post({.eye = {50, 0, 4}, .target = {50, 0, 0}});
        return shown.count < 4;
    };
    RenderLoop(redSquare(), Pace::newest, meshes, cameras, std::move(hooks)).join();
}

TEST(RenderLoop, EveryMeshDrawsOnceForEachWithItsOwnCamera) {
    Mailbox<FrameMeshes> meshes;
    Mailbox<CameraPose> cameras;
    const auto post = [&](std::uint64_t number) {
        const double x = number % 2 == 0 ? 0 : 50;
        FrameMeshes set = squareSet();
        set.request.number = number;
        set.request.camera = {.eye = {x, 0, 4}, .target = {x, 0, 0}};
        meshes.post(std::move(set));
    };
    RenderLoop::Hooks hooks;
    hooks.present = [&](const ShownFrame& shown, Renderer& renderer) {
        EXPECT_EQ(shown.meshes->request.number, shown.count);
        EXPECT_EQ(middle(renderer.readSrgb()), shown.count % 2 == 0 ? kRed : kBlack);
        post(shown.count + 1);
        return shown.count < 5;
    };
    post(0);
    RenderLoop(redSquare(), Pace::everyMesh, meshes, cameras, std::move(hooks)).join();
}

TEST(RenderLoop, StopEndsAWaitingLoop) {
    Mailbox<FrameMeshes> meshes;
    Mailbox<CameraPose> cameras;
    std::atomic<bool> ended{false};
    RenderLoop loop(
        redSquare(), Pace::everyMesh, meshes, cameras,
        {.present = [](const ShownFrame&, Renderer&) { return true; }, .ended = [&] { ended = true; }});
    loop.stop();
    loop.join();
    EXPECT_TRUE(ended);
}

TEST(RenderLoop, JoinRethrowsAFailedExtraction) {
    for (const Pace pace : {Pace::newest, Pace::everyMesh}) {
        Mailbox<FrameMeshes> meshes;
        Mailbox<CameraPose> cameras;
        FrameMeshes failed;
        failed.failure = std::make_exception_ptr(Error("cannot read", "key frame 3"));
        meshes.post(std::move(failed));
        std::atomic<bool> ended{false};
        RenderLoop loop(
            redSquare(), pace, meshes, cameras,
            {.present = [](const ShownFrame&, Renderer&) { return true; }, .ended = [&] { ended = true; }});
        EXPECT_THROW(loop.join(), Error);
        EXPECT_TRUE(ended);
    }
}

TEST(RenderLoop, JoinRethrowsWhatAHookThrows) {
    Mailbox<FrameMeshes> meshes;
    Mailbox<CameraPose> cameras;
    RenderLoop loop(
        redSquare(), Pace::newest, meshes, cameras,
        {.present = [](const ShownFrame&, Renderer&) -> bool { throw std::runtime_error("present"); }});
    EXPECT_THROW(loop.join(), std::runtime_error);
}

}  // namespace
}  // namespace isoglass
