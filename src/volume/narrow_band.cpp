#include "volume/narrow_band.h"

#include "volume/checksum.h"
#include "volume/series_grids.h"
#include "volume/series_save.h"
#include "volume/sparse_grid.h"

#include <openvdb/tools/LevelSetSphere.h>

#include <algorithm>

namespace isoglass {

namespace {

openvdb::FloatGrid::Ptr makeGrid(int samples, double radiusVoxels, double halfWidthVoxels) {
    const auto radius = static_cast<float>(radiusVoxels);
    const auto centre = static_cast<float>(0.5 * (samples - 1));
    return openvdb::tools::createLevelSetSphere<openvdb::FloatGrid>(radius, openvdb::Vec3f(centre), 1.0f,
                                                                    static_cast<float>(halfWidthVoxels));
}

std::shared_ptr<const KeyFrame> keyFrameOf(const openvdb::FloatGrid& grid, int samples) {
    return makeKeyFrame(grid, glm::ivec3(samples), glm::bvec3(false), /*inactiveIsMissing=*/false);
}

FrameRecord describeFrame(const openvdb::FloatGrid& grid, const KeyFrame& frame) {
    FrameRecord record;
    record.range = frame.range(0);
    for (std::size_t i = 1; i < frame.brickCount(); ++i) {
        record.range.min = std::min(record.range.min, frame.range(i).min);
        record.range.max = std::max(record.range.max, frame.range(i).max);
    }
    const glm::ivec3 dims = frame.dims();
    record.validSamples = static_cast<std::uint64_t>(dims.x) * dims.y * dims.z;
    record.activeVoxels = grid.tree().activeLeafVoxelCount();
    record.checksum = checksum(frame);
    record.bytes = frame.bytes();
    return record;
}

}  // namespace

std::shared_ptr<const KeyFrame> makeNarrowBandSphere(int samples, double radiusVoxels,
                                                     double halfWidthVoxels) {
    return keyFrameOf(*makeGrid(samples, radiusVoxels, halfWidthVoxels), samples);
}

void writeNarrowBandSphere(const std::filesystem::path& out, int samples, double radiusVoxels,
                           double halfWidthVoxels) {
    openvdb::initialize();
    AtomicFile file(out);
    SeriesDescription series;
    series.name = "distance";
    series.units = "voxels";
    series.lattice = makeUniformLattice(glm::ivec3(samples), glm::dvec3(0), glm::dvec3(1));
    series.time.times = {0};
    series.inactiveIsMissing = false;
    series.provenance = "generated: signed distance to a sphere";
    const auto grid = makeGrid(samples, radiusVoxels, halfWidthVoxels);
    grid->setName(gridName(series, 0));
    const auto keyFrame = keyFrameOf(*grid, samples);
    series.frames.push_back(describeFrame(*grid, *keyFrame));
    openvdb::GridPtrVec grids = {grid};
    series.frames.back().levels = addLevelGrids(series, 0, *keyFrame, grids);
    saveSeries(series, grids, file, out);
}

}  // namespace isoglass
