#include "pipeline/extraction_worker.h"

#include <gtest/gtest.h>

#include <atomic>
#include <latch>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>
#include <vector>

namespace isoglass {
namespace {

FrameRequest numbered(std::uint64_t number) {
    FrameRequest request;
    request.number = number;
    return request;
}

/// The next result; the stop never comes, so a lost result shows as the test's time limit.
FrameMeshes next(Mailbox<FrameMeshes>& results) {
    return *results.take(std::stop_token{});
}

TEST(ExtractionWorker, PublishesTheRequestWithItsMeshes) {
    Mailbox<FrameMeshes> results;
    ExtractionWorker worker(
        [](const FrameRequest& request) {
            SceneMeshes meshes;
            meshes.axisTimes = {2 * request.position};
            return meshes;
        },
        results);
    worker.request({.number = 3, .position = 0.25, .camera = {.eye = {1, 2, 3}, .target = {4, 5, 6}}});
    const FrameMeshes result = next(results);
    EXPECT_EQ(result.request.number, 3u);
    EXPECT_EQ(result.request.camera.eye, glm::dvec3(1, 2, 3));
    EXPECT_EQ(result.meshes.axisTimes, std::vector<double>{0.5});
    EXPECT_FALSE(result.failure);
}

TEST(ExtractionWorker, NewestRequestWinsWhileOneIsRunning) {
    Mailbox<FrameMeshes> results;
    std::latch started(1), released(1);
    std::mutex mutex;
    std::vector<std::uint64_t> worked;
    ExtractionWorker worker(
        [&](const FrameRequest& request) {
            {
                const std::scoped_lock lock(mutex);
                worked.push_back(request.number);
            }
            if (request.number == 1) {
                started.count_down();
                released.wait();
            }
            return SceneMeshes{};
        },
        results);
    worker.request(numbered(1));
    started.wait();
    for (std::uint64_t number = 2; number <= 9; ++number) worker.request(numbered(number));
    released.count_down();
    while (next(results).request.number != 9) {
    }
    const std::scoped_lock lock(mutex);
    EXPECT_EQ(worked, (std::vector<std::uint64_t>{1, 9}));
}

TEST(ExtractionWorker, FailureIsPublishedAndTheNextRequestIsWorkedOn) {
    Mailbox<FrameMeshes> results;
    ExtractionWorker worker(
        [](const FrameRequest& request) -> SceneMeshes {
            if (request.number == 1) throw std::runtime_error("request 1");
            return {};
        },
        results);
    worker.request(numbered(1));
    const FrameMeshes failed = next(results);
    EXPECT_EQ(failed.request.number, 1u);
    ASSERT_TRUE(failed.failure);
    try {
        std::rethrow_exception(failed.failure);
    } catch (const std::runtime_error& error) {
        EXPECT_EQ(std::string(error.what()), "request 1");
    }
    worker.request(numbered(2));
    EXPECT_FALSE(next(results).failure);
}

TEST(ExtractionWorker, DestructionWhileBusyWaitsForTheJob) {
    Mailbox<FrameMeshes> results;
    std::latch started(1), released(1);
    std::atomic<bool> finished{false};
    auto worker = std::make_unique<ExtractionWorker>(
        [&](const FrameRequest&) {
            started.count_down();
            released.wait();
            finished = true;
            return SceneMeshes{};
        },
        results);
    worker->request(numbered(1));
    started.wait();
    std::jthread destroyer([&] {
        worker.reset();
        EXPECT_TRUE(finished);
    });
    released.count_down();
    destroyer.join();
    const auto result = results.tryTake();
    ASSERT_TRUE(result.has_value());
    EXPECT_EQ(result->request.number, 1u);
}

TEST(ExtractionWorker, DestructionWhileIdleEnds) {
    Mailbox<FrameMeshes> results;
    {
        const ExtractionWorker worker([](const FrameRequest&) { return SceneMeshes{}; }, results);
    }
    EXPECT_FALSE(results.tryTake().has_value());
}

}  // namespace
}  // namespace isoglass
