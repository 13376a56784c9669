#include "formats/foreign_vdb.h"

#include "unit/formats/small_files.h"
#include "unit/volume/series_fixture.h"

#include <gtest/gtest.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/LevelSetSphere.h>

namespace isoglass {

namespace {

using openvdb::FloatGrid;
using test::failsWith;
using test::hasNote;

class ForeignVdb : public testing::Test {
  protected:
    void SetUp() override { openvdb::initialize(); }

    ScratchFolder folder_;

    std::filesystem::path file(const openvdb::GridPtrVec& grids,
                               const std::string& name = "smoke.vdb") const {
        openvdb::io::File((folder_ / name).string()).write(grids);
        return folder_ / name;
    }
    /// Smoke with the given voxels set to 10 x + y and the background 0.5.
    FloatGrid::Ptr smoke(std::initializer_list<openvdb::Coord> voxels,
                         const std::string& name = "density") const {
        auto grid = FloatGrid::create(0.5f);
        grid->setName(name);
        for (const openvdb::Coord& voxel : voxels)
            grid->tree().setValue(voxel, static_cast<float>(10 * voxel.x() + voxel.y()));
        return grid;
    }
    std::unique_ptr<FrameSource> open(const std::vector<std::filesystem::path>& files,
                                      const ImportOptions& options = {}) const {
        return openForeignVdb(files, options);
    }
};

TEST_F(ForeignVdb, BoxOfAllFramesWithOneVoxelAroundIsRead) {
    auto a = smoke({{3, 4, 5}, {5, 4, 5}}), b = smoke({{4, 6, 9}}), empty = smoke({});
    for (const auto& grid : {a, b, empty})
        grid->setTransform(openvdb::math::Transform::createLinearTransform(0.25));
    const auto source = open({file({a}, "s1.vdb"), file({empty}, "s2.vdb"), file({b}, "s3.vdb")});
    const SeriesDescription& series = source->description();
    EXPECT_EQ(series.name, "density");
    EXPECT_EQ(series.lattice.dims(), glm::ivec3(5, 5, 7));
    EXPECT_EQ(series.lattice.axes[0].coordinates, (std::vector<double>{0.5, 0.75, 1, 1.25, 1.5}));
    EXPECT_EQ(series.lattice.axes[2].coordinates.front(), 1);
    EXPECT_EQ(series.time.times, (std::vector<double>{0, 1, 2}));
    EXPECT_TRUE(hasNote(series, "background 0.5"));
    const auto samples = test::readFrame(*source, 0);
    const auto at = [&](int x, int y, int z) {
        return samples[static_cast<std::size_t>((z - 4) * 25 + (y - 3) * 5 + x - 2)];
    };
    EXPECT_EQ(at(3, 4, 5), 34);
    EXPECT_EQ(at(5, 4, 5), 54);
    EXPECT_EQ(at(4, 4, 5), 0.5f);
    EXPECT_EQ(test::readFrame(*source, 1), std::vector<float>(175, 0.5f));
    EXPECT_EQ(test::readFrame(*source, 2)[0 + 25 * 5 + 5 * 3 + 2], 46);
}

TEST_F(ForeignVdb, InsideOfALevelSetIsNegative) {
    const auto sphere = openvdb::tools::createLevelSetSphere<FloatGrid>(6, {0, 0, 0}, 0.5);
    sphere->setName("surface");
    const auto source = open({file({sphere})});
    const auto samples = test::readFrame(*source, 0);
    const glm::ivec3 dims = source->description().lattice.dims();
    // The middle is far from the narrow band, where no voxel is active.
    EXPECT_LT(samples[(static_cast<std::size_t>(dims.z / 2) * dims.y + dims.y / 2) * dims.x + dims.x / 2], 0);
    EXPECT_GT(samples[0], 0);
}

TEST_F(ForeignVdb, AxesOfTheTransformAreReordered) {
    auto grid = smoke({{0, 0, 0}, {2, 1, 0}});
    // Index x runs along world z, y against x, z along y: (i,j,k) -> (-2j, 3k, 4i).
    grid->setTransform(openvdb::math::Transform::createLinearTransform(
        openvdb::Mat4d(0, 0, 4, 0, -2, 0, 0, 0, 0, 3, 0, 0, 0, 0, 0, 1)));
    const auto source = open({file({grid})});
    const Lattice& lattice = source->description().lattice;
    EXPECT_EQ(lattice.axes[0].coordinates, (std::vector<double>{2, 0, -2, -4}));
    EXPECT_EQ(lattice.axes[1].coordinates, (std::vector<double>{-3, 0, 3}));
    EXPECT_EQ(lattice.axes[2].coordinates, (std::vector<double>{-4, 0, 4, 8, 12}));
    const auto samples = test::readFrame(*source, 0);
    // Voxel (2,1,0) is at world (-2,0,8): sample 2, 1, 3.
    EXPECT_EQ(samples[(3 * 3 + 1) * 4 + 2], 21);
    EXPECT_EQ(samples[(1 * 3 + 1) * 4 + 1], 0);
}

TEST_F(ForeignVdb, GridIsChosenByItsName) {
    auto velocity = openvdb::Vec3SGrid::create();
    velocity->setName("vel");
    auto heat = openvdb::DoubleGrid::create(1.0);
    heat->setName("heat");
    heat->tree().setValue({1, 1, 1}, 7.0);
    const auto path = file({smoke({{0, 0, 0}}), heat, velocity});
    EXPECT_TRUE(failsWith([&] { open({path}); }, {"several grids", "density, heat", "smoke.vdb"}));
    EXPECT_EQ(test::readFrame(*open({path}, {"heat", {}}), 0)[13], 7);
    EXPECT_TRUE(failsWith([&] { open({path}, {"vel", {}}); }, {"vel", "vec3s"}));
    EXPECT_TRUE(failsWith([&] { open({path}, {"fuel", {}}); }, {"no grid \"fuel\"", "density, heat"}));
    EXPECT_EQ(open({file({smoke({{0, 0, 0}}), velocity}, "one.vdb")})->description().name, "density");
}

TEST_F(ForeignVdb, WhatCannotBeReadIsRefused) {
    const auto good = file({smoke({{0, 0, 0}})}, "good.vdb");
    EXPECT_TRUE(failsWith([&] { open({file({smoke({})})}); }, {"no voxel is active", "smoke.vdb"}));
    EXPECT_TRUE(failsWith(
        [&] {
            open({file({smoke({{0, 0, 0}, {1 << 20, 1 << 20, 1 << 20}})})});
        },
        {"axis of"}));
    EXPECT_TRUE(failsWith(
                    [&] {
                        open({file({smoke({{0, 0, 0}, {500'000, 20'000, 0}})})});
                    },
                    {"2^34"}) ||
                failsWith(
                    [&] {
                        open({file({smoke({{0, 0, 0}, {500'000, 20'000, 0}})})});
                    },
                    {"too many for the memory"}));
    auto moved = smoke({{0, 0, 0}});
    moved->setTransform(openvdb::math::Transform::createLinearTransform(2));
    EXPECT_TRUE(failsWith(
        [&] {
            open({good, file({moved}, "moved.vdb")});
        },
        {"transform differs", "moved.vdb"}));
    EXPECT_TRUE(failsWith([&] { open({good, folder_ / "absent.vdb"}); }, {"no such file", "absent.vdb"}));
    EXPECT_TRUE(failsWith([&] { open({good}, {"", {1, 2}}); }, {"2 times for 1"}));
    test::write(folder_ / "text.vdb", "this is no volume");
    EXPECT_TRUE(
        failsWith([&] { open({folder_ / "text.vdb"}); }, {"not a readable OpenVDB file", "text.vdb"}));
    test::MemorySource own(test::describe(makeUniformLattice({9, 9, 9}, glm::dvec3(0), glm::dvec3(1)), 1),
                           {std::vector<float>(729, 1)});
    writeSeries(own, folder_ / "own.vdb");
    EXPECT_TRUE(failsWith([&] { open({folder_ / "own.vdb"}); }, {"series of IsoGlass already", "own.vdb"}));
}

}  // namespace

}  // namespace isoglass
