#include "pipeline/render_loop.h"

#include "base/error.h"
#include "gl/headless_context.h"
#include "pipeline/extraction_worker.h"
#include "threads/eventually.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
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

/// From above the place, as the scene's own camera looks.
RenderView view(glm::dvec2 place) {
    return {.camera = {.eye = {place, 4}, .target = {place, 0}}, .size = {32, 32}};
}

Rgba8 middle(const Image& image) {
    return image.at(image.size.x / 2, image.size.y / 2);
}

TEST(RenderLoop, PresentsHundredFramesWhileExtractionIsHeldAndTheMeshesAfterwards) {
    constexpr std::uint64_t kFrames = 100;
    std::latch started(1), released(1);
    RenderInbox inbox;
    std::uint64_t presentedWhileHeld = 0;
    Rgba8 before{}, after{};
    ExtractionWorker worker(
        [&](const FrameRequest&) {
            started.count_down();
            released.wait();
            return squareMeshes();
        },
        inbox.meshes);
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
            inbox.views.post(view({0, 0}));
        }
        return true;
    };
    RenderLoop(redSquare(), Pace::newest, inbox, std::move(hooks)).join();
    EXPECT_EQ(presentedWhileHeld, kFrames);
    EXPECT_EQ(before, kBlack);
    EXPECT_EQ(after, kRed);
}

TEST(RenderLoop, KeepsShowingTheOldMeshesWhileNewOnesAreMade) {
    RenderInbox inbox;
    inbox.meshes.post(squareSet());
    RenderLoop::Hooks hooks;
    hooks.present = [&](const ShownFrame& shown, Renderer& renderer) {
        EXPECT_EQ(middle(renderer.readSrgb()), kRed) << "frame " << shown.count;
        inbox.news.ring();
        return shown.count < 20;
    };
    RenderLoop(redSquare(), Pace::newest, inbox, std::move(hooks)).join();
}

TEST(RenderLoop, OldMeshesAreFreed) {
    RenderInbox inbox;
    RenderLoop::Hooks hooks;
    hooks.present = [&](const ShownFrame& shown, Renderer& renderer) {
        EXPECT_EQ(renderer.meshes().count(), shown.meshes ? 1u : 0u) << "frame " << shown.count;
        inbox.meshes.post(squareSet());
        return shown.count < 20;
    };
    RenderLoop(redSquare(), Pace::newest, inbox, std::move(hooks)).join();
}

TEST(RenderLoop, FollowsTheNewestCameraWithoutNewMeshes) {
    RenderInbox inbox;
    inbox.meshes.post(squareSet());
    RenderLoop::Hooks hooks;
    hooks.present = [&](const ShownFrame& shown, Renderer& renderer) {
        // From frame 2 on the camera looks past the square.
        EXPECT_EQ(middle(renderer.readSrgb()), shown.count < 2 ? kRed : kBlack) << "frame " << shown.count;
        if (shown.count == 1) inbox.views.post(view({50, 0}));
        if (shown.count != 1) inbox.news.ring();
        return shown.count < 4;
    };
    RenderLoop(redSquare(), Pace::newest, inbox, std::move(hooks)).join();
}

// The square moves by 4 to the right from key frame to key frame, and is the one of fraction 0.5; a position
// of 0.1 is one interval.
FrameMeshes movingSet(double limit) {
    FrameMeshes set = squareSet();
    set.request.position = 0.3;
    auto mesh = std::make_shared<SurfaceMesh>(*set.meshes.surfaces[0].mesh);
    mesh->velocities.assign(4, {4, 0, 0});
    set.meshes.surfaces[0].mesh = std::move(mesh);
    set.meshes.times = {{.frameA = 2, .frameB = 3, .fraction = 0.5}};
    set.meshes.fractionsPerPosition = {10};
    set.meshes.motionLimits = {limit};
    return set;
}

/// Left and right end of the square on the line through the middle, in world units, as pixels tell: each is
/// 8 tan(30 degrees) / 64 wide.
std::array<double, 2> endsOf(const Image& image) {
    int first = image.size.x;
    int last = -1;
    for (int x = 0; x < image.size.x; ++x) {
        if (image.at(x, image.size.y / 2) != kRed) continue;
        first = std::min(first, x);
        last = x;
    }
    const double pixel = 2 * 4 * std::tan(M_PI / 6) / image.size.x;
    return {(first - image.size.x / 2) * pixel, (last + 1 - image.size.x / 2) * pixel};
}

/// Where the square is seen at a position on the timeline.
std::array<double, 2> endsAt(std::optional<double> position, double limit) {
    RenderInbox inbox;
    inbox.meshes.post(movingSet(limit));
    inbox.views.post(
        {.camera = {.eye = {0, 0, 4}, .target = {0, 0, 0}}, .size = {64, 64}, .position = position});
    std::array<double, 2> ends{};
    RenderLoop::Hooks hooks;
    hooks.present = [&](const ShownFrame&, Renderer& renderer) {
        ends = endsOf(renderer.readSrgb());
        return false;
    };
    Scene scene = redSquare();
    scene.camera.fovDegrees = 60;
    RenderLoop(scene, Pace::newest, inbox, std::move(hooks)).join();
    return ends;
}

TEST(RenderLoop, MovesMeshesToTheDisplayedTimeButNotBeyondAKeyFrameOrTheLimit) {
    constexpr double kFar = 100;
    const auto expectAt = [](std::array<double, 2> ends, double center) {
        constexpr double kPixel = 0.0722;  // 8 tan(30 degrees) / 64
        EXPECT_NEAR(ends[0], std::max(center - 1, -2.31), kPixel);
        EXPECT_NEAR(ends[1], std::min(center + 1, 2.31), kPixel);
    };
    expectAt(endsAt(std::nullopt, kFar), 0);
    expectAt(endsAt(0.3, kFar), 0);
    expectAt(endsAt(0.31, kFar), 0.4);
    expectAt(endsAt(0.28, kFar), -0.8);
    expectAt(endsAt(0.31, 0.25), 0.25);
    expectAt(endsAt(0.41, kFar), 2);
    EXPECT_EQ(endsAt(0.41, kFar), endsAt(0.35, kFar)) << "the next key frame";
    EXPECT_EQ(endsAt(0.9, kFar), endsAt(0.3, kFar)) << "another moment";
}

TEST(RenderLoop, NothingIsDrawnWhereNothingChanged) {
    RenderInbox inbox;
    std::atomic<std::uint64_t> drawn{0};
    RenderLoop loop(redSquare(), Pace::newest, inbox, {.present = [&](const ShownFrame&, Renderer&) {
                        ++drawn;
                        return true;
                    }});
    // A loop that draws without being asked is ahead of the news at some point.
    for (std::uint64_t news = 1; news <= 50; ++news) {
        ASSERT_TRUE(test::eventually([&] { return drawn >= news; }));
        ASSERT_EQ(drawn, news);
        inbox.views.post(view({0, 0}));
    }
    loop.stop();
    loop.join();
}

TEST(RenderLoop, ImageHasTheSizeOfTheNewestView) {
    RenderInbox inbox;
    std::vector<glm::ivec2> sizes;
    RenderLoop::Hooks hooks;
    hooks.present = [&](const ShownFrame& shown, Renderer& renderer) {
        sizes.push_back(renderer.readSrgb().size);
        RenderView next = view({0, 0});
        next.size = {20, 10};
        inbox.views.post(next);
        return shown.count < 1;
    };
    RenderLoop(redSquare(), Pace::newest, inbox, std::move(hooks)).join();
    EXPECT_EQ(sizes, (std::vector<glm::ivec2>{{32, 32}, {20, 10}}));
}

/// Whoever posts a view and then an order finds that view, or a newer one, in the frame of the order.
TEST(RenderLoop, WhatWokenFindsIsForTheViewsThatWerePostedBefore) {
    constexpr int kLast = 200;
    RenderInbox inbox;
    Mailbox<int> orders(&inbox.news);
    std::optional<int> order;
    RenderLoop::Hooks hooks;
    hooks.woken = [&] { order = orders.tryTake(); };
    hooks.present = [&](const ShownFrame& shown, Renderer& renderer) {
        if (!order) return true;
        EXPECT_GE(renderer.readSrgb().size.x, *order) << "frame " << shown.count;
        return *order < 32 + kLast;
    };
    RenderLoop loop(redSquare(), Pace::newest, inbox, std::move(hooks));
    for (int number = 1; number <= kLast; ++number) {
        RenderView next = view({0, 0});
        // The size says which view it is; the scene's own is 32 wide.
        next.size = {32 + number, 4};
        inbox.views.post(next);
        orders.post(32 + number);
    }
    loop.join();
}

TEST(RenderLoop, WireframeDrawsTheEdgesAndNothingBetween) {
    RenderInbox inbox;
    inbox.meshes.post(squareSet());
    RenderView wires = view({0, 0});
    wires.wireframe = true;
    inbox.views.post(wires);
    Image image;
    RenderLoop::Hooks hooks;
    hooks.present = [&](const ShownFrame&, Renderer& renderer) {
        image = renderer.readSrgb();
        return false;
    };
    RenderLoop(redSquare(), Pace::newest, inbox, std::move(hooks)).join();
    const int middleRow = image.size.y / 2;
    int lit = 0;
    for (int x = 0; x < image.size.x; ++x) lit += image.at(x, middleRow) == kRed;
    // The row crosses the left side, the right side and the diagonal, none of them along itself.
    EXPECT_EQ(lit, 3);
}

TEST(RenderLoop, EveryMeshDrawsOnceForEachWithItsOwnCamera) {
    RenderInbox inbox;
    const auto post = [&](std::uint64_t number) {
        const double x = number % 2 == 0 ? 0 : 50;
        FrameMeshes set = squareSet();
        set.request.number = number;
        set.request.camera = {.eye = {x, 0, 4}, .target = {x, 0, 0}};
        inbox.meshes.post(std::move(set));
    };
    RenderLoop::Hooks hooks;
    hooks.present = [&](const ShownFrame& shown, Renderer& renderer) {
        EXPECT_EQ(shown.meshes->request.number, shown.count);
        EXPECT_EQ(middle(renderer.readSrgb()), shown.count % 2 == 0 ? kRed : kBlack);
        post(shown.count + 1);
        return shown.count < 5;
    };
    post(0);
    RenderLoop(redSquare(), Pace::everyMesh, inbox, std::move(hooks)).join();
}

TEST(RenderLoop, StopEndsAWaitingLoop) {
    RenderInbox inbox;
    std::atomic<bool> ended{false};
    RenderLoop loop(
        redSquare(), Pace::everyMesh, inbox,
        {.present = [](const ShownFrame&, Renderer&) { return true; }, .ended = [&] { ended = true; }});
    loop.stop();
    loop.join();
    EXPECT_TRUE(ended);
}

TEST(RenderLoop, JoinRethrowsAFailedExtraction) {
    for (const Pace pace : {Pace::newest, Pace::everyMesh}) {
        RenderInbox inbox;
        FrameMeshes failed;
        failed.failure = std::make_exception_ptr(Error("cannot read", "key frame 3"));
        inbox.meshes.post(std::move(failed));
        std::atomic<bool> ended{false};
        RenderLoop loop(
            redSquare(), pace, inbox,
            {.present = [](const ShownFrame&, Renderer&) { return true; }, .ended = [&] { ended = true; }});
        EXPECT_THROW(loop.join(), Error);
        EXPECT_TRUE(ended);
    }
}

TEST(RenderLoop, FailedHookTakesTheFailureAndTheOldMeshesStay) {
    RenderInbox inbox;
    inbox.meshes.post(squareSet());
    bool toldWhy = false;
    RenderLoop::Hooks hooks;
    hooks.failed = [&](const FrameMeshes& failed) {
        EXPECT_THROW(std::rethrow_exception(failed.failure), Error);
        EXPECT_EQ(failed.request.number, 7u);
        toldWhy = true;
    };
    hooks.present = [&](const ShownFrame& shown, Renderer& renderer) {
        EXPECT_EQ(middle(renderer.readSrgb()), kRed) << "frame " << shown.count;
        FrameMeshes failed;
        failed.request.number = 7;
        failed.failure = std::make_exception_ptr(Error("cannot read", "key frame 3"));
        inbox.meshes.post(std::move(failed));
        return shown.count < 1;
    };
    RenderLoop(redSquare(), Pace::newest, inbox, std::move(hooks)).join();
    EXPECT_TRUE(toldWhy);
}

TEST(RenderLoop, DrawsInTheContextThatItIsGivenAndEndsAfterItIsGone) {
    struct Witnessed final : gl::CurrentContext {
        explicit Witnessed(std::atomic<int>& alive) : count(alive) { ++count; }
        ~Witnessed() override { --count; }
        gl::Context& context() override { return headless.context(); }

        gl::HeadlessContext headless;
        std::atomic<int>& count;
    };
    RenderInbox inbox;
    std::atomic<int> alive{0};
    int aliveWhenPresented = 0, aliveWhenEnded = -1;
    RenderLoop(redSquare(), Pace::newest, inbox,
               {.makeContext = [&] { return std::make_unique<Witnessed>(alive); },
                .present =
                    [&](const ShownFrame&, Renderer&) {
                        aliveWhenPresented = alive;
                        return false;
                    },
                .ended = [&] { aliveWhenEnded = alive; }})
        .join();
    EXPECT_EQ(aliveWhenPresented, 1);
    EXPECT_EQ(aliveWhenEnded, 0);
}

TEST(RenderLoop, JoinRethrowsWhatAHookThrows) {
    RenderInbox inbox;
    RenderLoop loop(redSquare(), Pace::newest, inbox, {.present = [](const ShownFrame&, Renderer&) -> bool {
                        throw std::runtime_error("present");
                    }});
    EXPECT_THROW(loop.join(), std::runtime_error);
}

}  // namespace
}  // namespace isoglass
