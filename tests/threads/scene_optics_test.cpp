#include "base/error.h"
#include "pipeline/batch.h"
#include "pipeline/render_loop.h"
#include "pipeline/scene_extractor.h"
#include "threads/damage.h"
#include "unit/volume/series_fixture.h"
#include "volume/analytic.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace isoglass {
namespace {

float slope(glm::dvec3 position, double time) {
    return static_cast<float>(position.x + time);
}

/// Clip planes and colours as a scene describes them.
class SceneOptics : public testing::Test {
  protected:
    ScratchFolder folder_;
    Scene scene_;

    void SetUp() override {
        Volume volume;
        volume.name = "blobs";
        volume.series = write("blobs.vdb", blobs);
        volume.surfaces = {{.iso = 0.2, .color = {0.1f, 0.4f, 0.9f}},
                           {.iso = 0.3, .color = {0.9f, 0.3f, 0.1f}}};
        scene_.volumes = {std::move(volume)};
        scene_.time = {.from = 0.5, .to = 0.5};
        scene_.camera.pose = {{3, 2, 2.5}, {0, 0, 0}};
        scene_.image.size = {160, 120};
    }

    std::filesystem::path write(const std::string& name, const AnalyticField& field) {
        const Lattice lattice = makeUnitLattice(25);
        test::MemorySource source(test::describe(lattice, 2),
                                  {sampleField(lattice, field, 0), sampleField(lattice, field, 1)});
        writeSeries(source, folder_ / name);
        return folder_ / name;
    }

    SceneMeshes extract() {
        SceneExtractor extractor(scene_, {});
        return extractor.extract(0, scene_.camera.pose, scene_.image.size);
    }

    Image render() {
        SceneExtractor extractor(scene_, {});
        Image image;
        renderFrames(scene_, extractor, {0, 0}, [&image](RenderedFrame frame) {
            image = std::move(frame.image);
            return true;
        });
        return image;
    }
};

/// Of every vertex of every mesh; an empty scene has none.
std::vector<double> distances(const SceneMeshes& meshes, const glm::dmat4& worldFromSeries,
                              const glm::dvec4& plane) {
    std::vector<double> all;
    for (const ExtractedSurface& surface : meshes.surfaces) {
        for (const glm::vec3& position : surface.mesh->positions) {
            const glm::dvec4 world =
                worldFromSeries * glm::dvec4(surface.mesh->origin + glm::dvec3(position), 1);
            all.push_back(glm::dot(plane, world));
        }
    }
    return all;
}

TEST_F(SceneOptics, PlanesOfTheSceneCutInTheWorldThoseOfAVolumeInItsSeries) {
    Volume& volume = scene_.volumes[0];
    volume.place = {.translate = {5, -1, 2}, .rotate = {1, 2, 3, 50}, .scale = {2, 0.5, -1}};
    const glm::dmat4 place = worldFromSeries(volume.place);
    const glm::dvec4 plane(0.3, -1, 0.2, -0.3 * 5 - 1 - 0.4);  // through the middle of the placed volume
    const glm::dvec4 own(1, 1, 0, 0.1);
    scene_.clip = {{plane}};
    for (const double distance : distances(extract(), place, plane)) ASSERT_GT(distance, -1e-5);
    scene_.clip.clear();
    volume.clip = {{own}};
    const SceneMeshes cut = extract();
    for (const double distance : distances(cut, glm::dmat4(1), own)) ASSERT_GT(distance, -1e-5);
    ASSERT_EQ(cut.surfaces.size(), 4u);
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_EQ(cut.surfaces[i].surface, i / 2);
        EXPECT_EQ(cut.surfaces[i].caps, i % 2 == 1);
        EXPECT_FALSE(cut.surfaces[i].mesh->empty());
    }
}

TEST_F(SceneOptics, CapsLookLikeTheirSurfaceAndInnerOnesLieInFront) {
    scene_.volumes[0].clip = {{{1, 1, 0, 0.1}}};
    scene_.volumes[0].surfaces[1].shell = ShellOpacity{.extinction = 10, .thickness = 0.05f};
    const auto draws = surfaceDraws(scene_, extract());
    ASSERT_EQ(draws.size(), 4u);
    EXPECT_EQ(draws[1].color, draws[0].color);
    EXPECT_TRUE(draws[1].opaque());
    EXPECT_GT(draws[3].depthRank, draws[1].depthRank);
    EXPECT_FALSE(draws[3].shell);
    EXPECT_NEAR(draws[3].opacity, 1 - std::exp(-0.5), 1e-6);
}

TEST_F(SceneOptics, ClippingEverythingExtractsNothing) {
    scene_.clip = {{{1, 0, 0, -9}}};
    for (const ExtractedSurface& surface : extract().surfaces) {
        EXPECT_EQ(surface.stats.touchedBricks, 0u);
        EXPECT_TRUE(surface.mesh->empty());
    }
}

TEST_F(SceneOptics, OnAKeyFrameTheSecondOneIsNotRead) {
    const auto extractBesideDamage = [this](double time) {
        scene_.time = {.from = time, .to = time};
        scene_.volumes[0].series = write("damaged.vdb", blobs);
        SceneExtractor extractor(scene_, {});
        test::damageEnd(folder_ / "damaged.vdb");  // samples of the second key frame
        return extractor.extract(0, scene_.camera.pose, {160, 120}).surfaces[0].mesh->triangleCount();
    };
    EXPECT_GT(extractBesideDamage(0), 0u);
    EXPECT_THROW(extractBesideDamage(0.5), Error);
}

TEST_F(SceneOptics, PlanesMoveFromCallToCall) {
    SceneExtractor extractor(scene_, {});
    std::vector<std::size_t> triangles;
    for (const double offset : {2.0, 0.5, 0.0, -0.5, 2.0}) {
        extractor.setClip({{{1, 0, 0, offset}}});
        const SceneMeshes meshes = extractor.extract(0, scene_.camera.pose, {160, 120});
        triangles.push_back(meshes.surfaces[0].mesh->triangleCount());
    }
    EXPECT_GT(triangles[0], triangles[1]);
    EXPECT_GT(triangles[1], triangles[2]);
    EXPECT_GT(triangles[2], triangles[3]);
    EXPECT_EQ(triangles[0], triangles[4]);
}

TEST_F(SceneOptics, AnotherSeriesColoursASurfaceAtTheSameTime) {
    scene_.volumes[0].surfaces[0].fieldColor =
        FieldColor{FieldColor::By::series, write("slope.vdb", slope), 0, -1, 2};
    const SceneMeshes meshes = extract();
    const SurfaceMesh& mesh = *meshes.surfaces[0].mesh;
    ASSERT_EQ(mesh.colorValues.size(), mesh.vertexCount());
    for (std::size_t i = 0; i < mesh.vertexCount(); ++i) {
        // Values of up to 2, rounded to float a few times.
        ASSERT_NEAR(mesh.colorValues[i], mesh.positions[i].x + 0.5, 2 * 0x1p-21);
    }
    EXPECT_TRUE(meshes.surfaces[1].mesh->colorValues.empty());
    const auto draws = surfaceDraws(scene_, meshes);
    EXPECT_EQ(draws[0].colorBar, (LegendBar{0, -1, 2}));
    EXPECT_FALSE(draws[1].colorBar);
}

TEST_F(SceneOptics, ALegendIsDrawnUnlessTheSceneLeavesItOut) {
    scene_.volumes[0].surfaces[0].fieldColor = FieldColor{FieldColor::By::curvature, {}, 1, -5, 5};
    const Image with = render();
    scene_.image.legend = false;
    const Image without = render();
    std::size_t changed = 0;
    for (int y = 0; y < with.size.y; ++y) {
        for (int x = 0; x < with.size.x; ++x) {
            if (with.at(x, y) == without.at(x, y)) continue;
            ++changed;
            EXPECT_GT(x, with.size.x / 2) << "the legend is at the right edge";
        }
    }
    EXPECT_GT(changed, 500u);
}

}  // namespace
}  // namespace isoglass
