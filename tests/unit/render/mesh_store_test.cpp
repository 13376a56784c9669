#include "render/mesh_store.h"

#include "render_fixture.h"

#include <stdexcept>

namespace isoglass::test {
namespace {

using MeshStoreTest = RenderTest;

TEST_F(MeshStoreTest, HoldsWhatWasUploadedUntilItIsReleased) {
    MeshStore& store = renderer_.meshes();
    const MeshId id = store.upload(quad(2, 3));
    EXPECT_EQ(store.count(), 1u);
    // 4 positions and 4 normals of 12 bytes, 6 indices of 4.
    EXPECT_EQ(store.bytes(), 4u * 12 + 4 * 12 + 6 * 4);
    EXPECT_EQ(store.get(id).indexCount, 6);
    EXPECT_EQ(store.get(id).bounds.low, glm::dvec3(-3, -3, 2));
    EXPECT_EQ(store.get(id).bounds.high, glm::dvec3(3, 3, 2));
    store.release(id);
    EXPECT_EQ(store.count(), 0u);
    EXPECT_EQ(store.bytes(), 0u);
}

TEST_F(MeshStoreTest, AnUnknownIdIsRefused) {
    MeshStore& store = renderer_.meshes();
    const MeshId id = store.upload(quad(0, 1));
    store.release(id);
    EXPECT_THROW(store.release(id), std::invalid_argument);
    EXPECT_THROW(store.get(id), std::invalid_argument);
    EXPECT_NE(store.upload(quad(0, 1)), id) << "an id was used again";
    FrameDescription frame{.camera = fromAbove(10)};
    frame.draws.push_back({.mesh = id});
    EXPECT_THROW(renderer_.render(frame), std::invalid_argument);
}

TEST_F(MeshStoreTest, AnEmptyMeshIsDrawnAsNothing) {
    FrameDescription frame{.camera = fromAbove(10), .background = {0.5f, 0.25f, 0.125f}};
    show(frame, {{SurfaceMesh{}, {.opacity = 0.5f}}, {SurfaceMesh{}, {}}});
    EXPECT_EQ(renderLinear(frame).at(3, 3), frame.background);
    EXPECT_EQ(renderer_.plan().passes.size(), 2u);
}

TEST_F(MeshStoreTest, TheOldMeshStaysDrawableWhileANewOneIsUploaded) {
    FrameDescription frame{.camera = fromAbove(10), .lighting = kUnlit};
    show(frame, {{quad(0, 8), {.color = {1, 0, 0}}}});
    const LinearImage before = renderLinear(frame);
    const MeshId next = renderer_.meshes().upload(quad(0, 0.1f));
    EXPECT_EQ(renderLinear(frame).pixels, before.pixels);
    renderer_.meshes().release(frame.draws[0].mesh);
    frame.draws[0].mesh = next;
    const LinearImage after = renderLinear(frame);
    EXPECT_EQ(after.at(0, 0), glm::vec3(0));
    EXPECT_EQ(after.at(16, 16), glm::vec3(1, 0, 0));
}

}  // namespace
}  // namespace isoglass::test
