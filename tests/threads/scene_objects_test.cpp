// Meshes of files, from the scene to the picture, and the style "illustrative" with them.

#include "pipeline/scene_objects.h"

#include "base/error.h"
#include "gl/headless_context.h"
#include "meshio/mesh_file.h"
#include "pipeline/batch.h"
#include "pipeline/render_loop.h"
#include "unit/mesh_io/example_meshes.h"
#include "unit/volume/series_fixture.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

namespace isoglass {
namespace {

constexpr std::int64_t kFrames = 5;

class SceneObjectsTest : public testing::Test {
  protected:
    ScratchFolder folder_;
    Scene scene_;

    void SetUp() override {
        SurfaceMesh cube = makeCube();
        cube.normals.clear();
        writeMesh(folder_ / "cube.ply", cube);
        scene_.meshes = {{.name = "cube", .file = folder_ / "cube.ply", .color = {0, 0, 1}}};
        scene_.meshes[0].place.translate = glm::dvec3(-0.5);
        scene_.camera.pose = {.eye = {20, 0, 0}, .target = {0, 0, 0}};
        scene_.camera.fovDegrees = 6;
        scene_.image.size = {96, 96};
        scene_.image.background = LinearColor(0);
        scene_.lighting = {.ambient = 1, .diffuse = 0, .specular = 0, .shininess = 1};
    }

    /// |p| - 0.5 - t / 10 over [-1, 1]^3: a ball that grows within the cube, which is 0.5 to each side, and
    /// out of it.
    void addBall() {
        const Lattice lattice = makeUniformLattice(glm::ivec3(41), glm::dvec3(-1), glm::dvec3(0.05));
        std::vector<std::vector<float>> frames(2);
        for (std::size_t frame = 0; frame < 2; ++frame) {
            for (int z = 0; z < 41; ++z) {
                for (int y = 0; y < 41; ++y) {
                    for (int x = 0; x < 41; ++x) {
                        const double r = glm::length(0.05 * glm::dvec3(x, y, z) - 1.0);
                        frames[frame].push_back(static_cast<float>(r - 0.4 * static_cast<double>(frame)));
                    }
                }
            }
        }
        test::MemorySource source(test::describe(lattice, 2), std::move(frames));
        writeSeries(source, folder_ / "ball.vdb");
        Volume volume;
        volume.name = "ball";
        volume.series = folder_ / "ball.vdb";
        volume.surfaces = {{.iso = 0.3, .inside = Inside::below, .color = {1, 0, 0}}};
        scene_.volumes = {volume};
        scene_.time = {.from = 0.0, .to = 1.0, .duration = kFrames / 25.0, .fps = 25};
    }

    std::vector<Image> play() {
        SceneExtractor extractor(scene_, {.threads = 2});
        std::vector<Image> images;
        renderFrames(scene_, extractor, {0, scene_.time.frameCount() - 1}, [&](RenderedFrame frame) {
            images.push_back(std::move(frame.image));
            return true;
        });
        return images;
    }

    static int count(const Image& image, Rgba8 color) {
        return static_cast<int>(std::ranges::count(image.pixels, color));
    }
};

constexpr Rgba8 kBlue{0, 0, 255, 255}, kRed{255, 0, 0, 255};

/// Its face at x = 0.5 is 1 wide at distance 19.5: 96 pixels show 2 x 20 x tan(3 degrees) at distance 20.
TEST_F(SceneObjectsTest, AMeshAloneIsAScene) {
    const std::vector<Image> images = play();
    ASSERT_EQ(images.size(), 1u);
    const double side = 96 / (2 * std::tan(3 * M_PI / 180)) / 19.5;
    // Each of the four edges runs through a row of pixels at most.
    EXPECT_NEAR(count(images[0], kBlue), side * side, 2 * side + 1);
}

TEST_F(SceneObjectsTest, ItStandsAmongMovingSurfaces) {
    addBall();
    const std::vector<Image> images = play();
    ASSERT_EQ(images.size(), static_cast<std::size_t>(kFrames));
    // The ball reaches 0.3 + 0.4 t: within the cube at first, and beyond it where it is larger than 0.5.
    EXPECT_EQ(count(images[0], kRed), 0);
    EXPECT_GT(count(images[4], kRed), 0);
    EXPECT_GT(count(images[4], kBlue), 0);
}

/// Uploaded once for all frames: a million triangles are not sent again.
TEST_F(SceneObjectsTest, ItIsUploadedOnce) {
    gl::HeadlessContext context;
    MeshStore store(context.context());
    MeshUploads uploads;
    const auto cube = std::make_shared<const SurfaceMesh>(makeCube());
    const auto first = std::make_shared<const SurfaceMesh>(makeCube());
    const auto next = std::make_shared<const SurfaceMesh>(makeCube());
    const std::vector<MeshId> before = uploads.replace({first, cube, cube}, store);
    EXPECT_EQ(before[1], before[2]);
    EXPECT_EQ(store.count(), 2u);
    const std::vector<MeshId> after = uploads.replace({next, cube}, store);
    EXPECT_EQ(after[1], before[1]);
    EXPECT_NE(after[0], before[0]);
    EXPECT_EQ(store.count(), 2u);
    EXPECT_THROW(store.get(before[0]), std::invalid_argument);
}

/// Within the cube the ball is hidden; as secondary geometry it shows through, darker, also while it moves.
TEST_F(SceneObjectsTest, SecondaryGeometryShowsThroughTheMesh) {
    addBall();
    scene_.volumes[0].surfaces[0].secondary = true;
    scene_.illustrative = IllustrativeStyle{.light = {0, 0, 1}, .paper = {1, 1, 1}};
    const std::vector<Image> images = play();
    // Along the row through the middle the ball tints the white paper wherever its normal is less than 85 degrees
    // from the light: there 8 bits tell red from green.
    const double pixelsPerUnit = 96 / (2 * std::tan(3 * M_PI / 180)) / 20;
    for (std::int64_t i = 0; i < kFrames; ++i) {
        const Image& image = images[static_cast<std::size_t>(i)];
        int tinted = 0;
        for (int x = 0; x < image.size.x; ++x) tinted += image.at(x, 48).r > image.at(x, 48).g;
        const double radius = 0.3 + 0.4 * static_cast<double>(i) / kFrames;
        // Faceted by cells of 0.05; a pixel at either end. The cube's edges, 0.5 away, are lines of two
        // pixels.
        const double lines = radius > 0.5 ? 4 : 0;
        EXPECT_NEAR(tinted + lines, 2 * radius * pixelsPerUnit, 0.05 * pixelsPerUnit + 2) << i;
    }
    // In the middle: seen straight on, behind the first surface of the cube, before the second one.
    const Rgba8 middle = images[0].at(48, 48);
    // sRGB of (1, 0.3, 0.3): paper 1 - alpha.
    EXPECT_EQ(middle.r, 255);
    EXPECT_NEAR(middle.g, 148, 2);
}

TEST_F(SceneObjectsTest, MeshesWithoutNormalsGetThem) {
    std::ofstream(folder_ / "quad.obj") << "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";
    const ObjectMesh read = readObject({.name = "quad", .file = folder_ / "quad.obj"});
    ASSERT_EQ(read.mesh->normals.size(), 4u);
    for (const glm::vec3& normal : read.mesh->normals) EXPECT_EQ(normal, glm::vec3(0, 0, 1));
    ASSERT_EQ(read.notes.size(), 1u);
    EXPECT_NE(read.notes[0].find("triangles: 1"), std::string::npos) << read.notes[0];
}

/// Wound inwards, with normals that point outwards: it is seen from outside all the same.
TEST_F(SceneObjectsTest, WindingFollowsTheNormals) {
    std::ofstream(folder_ / "turned.obj")
        << "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nf 1//1 3//1 2//1\n";
    const ObjectMesh read = readObject({.name = "turned", .file = folder_ / "turned.obj"});
    EXPECT_EQ(read.mesh->triangles, (std::vector<std::uint32_t>{0, 1, 2}));
    EXPECT_EQ(read.mesh->normals[0], glm::vec3(0, 0, 1));
}

/// That of a vertex which nobody names does not matter.
TEST_F(SceneObjectsTest, NormalsWithoutADirectionAreReplacedAndCounted) {
    std::ofstream(folder_ / "flat.ply")
        << "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
           "property float nx\nproperty float ny\nproperty float nz\nelement face 1\n"
           "property list uchar int vertex_indices\nend_header\n"
           "0 0 0 0 0 2\n1 0 0 0 0 0\n0 1 0 0 0 2\n9 9 9 0 0 0\n3 0 1 2\n";
    const ObjectMesh read = readObject({.name = "flat", .file = folder_ / "flat.ply"});
    for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(read.mesh->normals[i], glm::vec3(0, 0, 1));
    ASSERT_EQ(read.notes.size(), 1u);
    EXPECT_NE(read.notes[0].find("made anew: 1"), std::string::npos) << read.notes[0];
}

TEST_F(SceneObjectsTest, FilesThatAreNoMeshesAreNamed) {
    scene_.meshes[0].file = folder_ / "missing.ply";
    EXPECT_THROW(SceneExtractor(scene_, {}), Error);
    std::ofstream(folder_ / "nan.obj") << "v 0 0 0\nv nan 0 0\nv 1 1 0\nf 1 2 3\n";
    scene_.meshes[0].file = folder_ / "nan.obj";
    EXPECT_THROW(SceneExtractor(scene_, {}), Error);
}

}  // namespace
}  // namespace isoglass
