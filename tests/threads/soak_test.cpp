// Many displayed frames over a looped series with a moving eye, as the viewer plays it.

#include "pipeline/render_loop.h"
#include "pipeline/scene_extractor.h"
#include "threads/eventually.h"
#include "threads/soak_scene.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <cstdio>
#include <fstream>

namespace isoglass {
namespace {

std::size_t residentBytes() {
    std::ifstream statm("/proc/self/statm");
    std::size_t total = 0;
    std::size_t resident = 0;
    statm >> total >> resident;
    return resident * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
}

/// What the render thread has shown.
struct Shown {
    std::atomic<std::uint64_t> drawn{0};
    std::atomic<std::uint64_t> request{0};
    std::atomic<std::size_t> meshes{0};
    std::atomic<std::size_t> meshBytes{0};
};

TEST(Soak, MeshesAndKeyFramesStayWithinBoundsAndTheLastFrameOfEveryLapIsShown) {
    constexpr std::size_t kBudget = 2'500'000;
    const ScratchFolder folder;
    const Scene scene = test::makeSoakScene(folder / "swing.vdb");
    SceneExtractor extractor(scene,
                             {.memoryBytes = kBudget, .threads = 2, .seenMargin = 0.5, .motion = true});
    RenderInbox inbox;
    ExtractionWorker worker(
        [&](const FrameRequest& request) {
            return extractor.extract(request.position, request.camera, request.imageSize);
        },
        inbox.meshes);
    Shown shown;
    RenderLoop::Hooks hooks;
    hooks.present = [&](const ShownFrame& frame, Renderer& renderer) {
        shown.meshes = renderer.meshes().count();
        shown.meshBytes = renderer.meshes().bytes();
        if (frame.meshes) shown.request = frame.meshes->request.number;
        ++shown.drawn;
        return true;
    };
    RenderLoop loop(scene, Pace::newest, inbox, std::move(hooks));

    const std::uint64_t frames = test::soakFrames();
    std::size_t lapMeshBytes = 0;
    std::size_t residentAtFirst = 0;
    for (std::uint64_t frame = 1; frame <= frames; ++frame) {
        const FrameRequest request = test::soakRequest(frame, scene.image.size);
        const std::uint64_t before = shown.drawn;
        inbox.views.post({.camera = request.camera, .size = request.imageSize, .position = request.position});
        worker.request(request);
        ASSERT_TRUE(test::eventually([&] { return shown.drawn > before; })) << "frame " << frame;
        EXPECT_LE(extractor.cache().bytes(), kBudget);
        if (frame % test::kFramesPerLap != 0) continue;
        ASSERT_TRUE(test::eventually([&] { return shown.request == frame; })) << "the last frame was missed";
        EXPECT_EQ(shown.meshes, 2u);
        if (lapMeshBytes == 0) lapMeshBytes = shown.meshBytes;
        EXPECT_EQ(shown.meshBytes, lapMeshBytes) << "the same moment seen from the same place";
        if (frame >= frames / 4 && residentAtFirst == 0) residentAtFirst = residentBytes();
    }
    loop.stop();
    loop.join();
    std::size_t held = 0;
    for (std::size_t frame = 0; frame < test::kKeyFrames; ++frame)
        held += extractor.cache().holds({0, frame});
    EXPECT_LT(held, test::kKeyFrames) << "the budget is to be too small for all";
    const std::size_t resident = residentBytes();
    std::printf("%llu displayed frames, %.1f MB resident after the first quarter, %.1f MB at the end\n",
                static_cast<unsigned long long>(frames), static_cast<double>(residentAtFirst) * 1e-6,
                static_cast<double>(resident) * 1e-6);
    // A set of meshes takes some 100 kB: a hundredth of one left behind by every frame is a leak. Few frames
    // cannot tell it from the allocator's own rounding.
    if (frames >= 10'000) {
        EXPECT_LT(resident, residentAtFirst + lapMeshBytes / 100 * frames);
    }
}

}  // namespace
}  // namespace isoglass
