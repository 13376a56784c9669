// The hand-offs of playback without drawing, for the thread sanitizer.

#include "pipeline/scene_extractor.h"
#include "threads/soak_scene.h"

#include <gtest/gtest.h>

#include <thread>

namespace isoglass {
namespace {

TEST(SoakExtraction, EveryLapEndsWithItsLastFrame) {
    constexpr std::size_t kBudget = 4'000'000;
    const ScratchFolder folder;
    // One leaf: the sanitizer does not know the loops that OpenVDB runs over several.
    const Scene scene = test::makeSoakScene(folder / "swing.vdb", 8);
    SceneExtractor extractor(scene,
                             {.memoryBytes = kBudget, .threads = 2, .seenMargin = 0.5, .motion = true});
    Mailbox<FrameMeshes> results;
    ExtractionWorker worker(
        [&](const FrameRequest& request) {
            return extractor.extract(request.position, request.camera, request.imageSize);
        },
        results);
    const std::uint64_t frames = 2 * test::kFramesPerLap;
    std::stop_source stop;
    for (std::uint64_t frame = 1; frame <= frames; ++frame) {
        worker.request(test::soakRequest(frame, scene.image.size));
        EXPECT_LE(extractor.cache().bytes(), kBudget);
        // The viewer goes on while meshes are made, but not by a whole lap.
        if (frame % 4 != 0) continue;
        for (std::uint64_t number = 0; number != frame;) {
            const auto taken = results.take(stop.get_token());
            ASSERT_TRUE(taken);
            ASSERT_FALSE(taken->failure);
            EXPECT_EQ(taken->meshes.surfaces.size(), 2u);
            EXPECT_GT(taken->request.number, number);
            number = taken->request.number;
        }
    }
}

}  // namespace
}  // namespace isoglass
