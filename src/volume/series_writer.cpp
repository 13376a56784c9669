#include "base/atomic_file.h"
#include "base/error.h"
#include "basis/parallel.h"
#include "volume/brick_fates.h"
#include "volume/checksum.h"
#include "volume/heights.h"
#include "volume/lattice_check.h"
#include "volume/pyramid.h"
#include "volume/series_file.h"
#include "volume/series_grids.h"
#include "volume/series_json.h"
#include "volume/series_save.h"
#include "volume/series_seal.h"
#include "volume/sparse_grid.h"

#include <openvdb/io/File.h>
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iomanip>
#include <limits>
#include <sstream>

namespace isoglass {

namespace {

FrameRecord describeFrame(const openvdb::FloatGrid& grid, const KeyFrame& frame,
                          std::span<const float> samples) {
    FrameRecord record;
    record.range = {std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity()};
    for (const float value : samples) {
        if (std::isnan(value)) continue;
        record.range.min = std::min(record.range.min, value);
        record.range.max = std::max(record.range.max, value);
        ++record.validSamples;
    }
    record.activeVoxels = grid.tree().activeLeafVoxelCount();
    record.checksum = checksum(frame);
    record.bytes = frame.bytes();
    if (frame.heights()) record.heightsChecksum = checksum(*frame.heights());
    return record;
}

/// Other OpenVDB programs see the lattice in place where its axes are even.
openvdb::math::Transform::Ptr transformOf(const Lattice& lattice) {
    openvdb::Vec3d scale;
    openvdb::Vec3d origin;
    for (int k = 0; k < 3; ++k) {
        const Axis& axis = lattice.axes[k];
        const double length = axis.coordinates.back() - axis.coordinates.front();
        scale[k] = axis.size() > 1 ? length / static_cast<double>(axis.size() - 1) : 1.0;
        origin[k] = axis.coordinates.front();
    }
    auto transform = openvdb::math::Transform::createLinearTransform();
    transform->preScale(scale);
    transform->postTranslate(origin);
    return transform;
}

/// OpenVDB stamps every file with a random identifier; one made from the content keeps the same input
/// giving the same bytes. Layout of the header: 8 bytes magic, 4 file version, 4 + 4 library version,
/// 1 for the offsets, then the identifier as text.
void stampIdentifier(const std::filesystem::path& path, const std::filesystem::path& finalPath,
                     const std::string& description) {
    constexpr std::streamoff kIdentifierOffset = 21;
    constexpr std::size_t kIdentifierLength = 36;
    std::string digits;
    uLong crc = crc32(0, nullptr, 0);
    while (digits.size() < kIdentifierLength) {
        crc = crc32(crc, reinterpret_cast<const Bytef*>(description.data()),
                    static_cast<uInt>(description.size()));
        std::ostringstream word;
        word << std::hex << std::setw(8) << std::setfill('0') << crc;
        digits += word.str();
    }
    digits.resize(kIdentifierLength);
    for (const std::size_t dash : {8, 13, 18, 23}) digits[dash] = '-';
    std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
    std::string found(kIdentifierLength, ' ');
    file.seekg(kIdentifierOffset).read(found.data(), kIdentifierLength);
    if (!file || found[8] != '-' || found[23] != '-')
        throw Error("OpenVDB could not write its header", finalPath.string(),
                    "free some space, or choose another place");
    file.seekp(kIdentifierOffset).write(digits.data(), kIdentifierLength);
    file.close();
    if (!file) throw Error("cannot write", finalPath.string(), "free some space, or choose another place");
}

/// OpenVDB does not look at its stream at the end, so a full disk goes unnoticed: read all back.
void checkWritten(const std::filesystem::path& path, const std::filesystem::path& finalPath) {
    try {
        const SeriesFile file(path);
        const auto& frames = file.description().frames;
        for (std::size_t i = 0; i < frames.size(); ++i) {
            for (int level = 0; level <= static_cast<int>(frames[i].levels.size()); ++level)
                file.readLevel(i, level);
        }
    } catch (const Error& failure) {
        throw Error(std::string("the file cannot be read back: ") + failure.what(), finalPath.string(),
                    "free some space on the disk, or choose another place");
    }
}

std::vector<std::vector<BrickFate>> allFates(FrameSource& source, const SparsityOptions& options,
                                             std::vector<float>& samples) {
    const SeriesDescription& series = source.description();
    const std::size_t count = series.time.times.size();
    if (!options.keep) return std::vector<std::vector<BrickFate>>(count);
    std::vector<std::vector<BrickSide>> sides(count);
    for (std::size_t i = 0; i < count; ++i) {
        source.read(i, samples);
        sides[i] = brickSides(series.lattice.dims(), samples, *options.keep);
    }
    return fatesToKeep(series.lattice, sides, series.time.period.has_value(), *options.keep);
}

openvdb::FloatGrid::Ptr nameGrid(openvdb::FloatGrid::Ptr grid, const std::string& name,
                                 const Lattice& lattice, double time) {
    grid->setName(name);
    grid->setTransform(transformOf(lattice));
    grid->insertMeta("isoglass.time", openvdb::DoubleMetadata(time));
    return grid;
}

/// Checks the heights of the key frames and makes grids of them.
class HeightsWriter {
  public:
    explicit HeightsWriter(const SeriesDescription& series) : series_(series), check_(series.lattice) {}

    /// `samples` are the values of key frame `frame`; the new grid is appended to `grids`.
    std::shared_ptr<const KeyFrame> add(FrameSource& source, std::size_t frame,
                                        std::span<const float> samples, openvdb::GridPtrVec& grids) {
        const glm::ivec3 dims = series_.lattice.dims();
        heights_.resize(samples.size());
        source.readHeights(frame, heights_);
        check_.add(frame, samples, heights_);
        const auto grid = nameGrid(makeSparseGrid(dims, heights_, 0), heightsGridName(series_, frame),
                                   series_.lattice, series_.time.times[frame]);
        grids.push_back(grid);
        return makeKeyFrame(*grid, dims, periodicAxes(series_.lattice), true);
    }

    /// Completes the description.
    void finish(HeightField& heights) const {
        check_.finish();
        heights.min = check_.min();
        heights.max = check_.max();
    }

  private:
    const SeriesDescription& series_;
    HeightCheck check_;
    std::vector<float> heights_;
};

}  // namespace

std::string gridName(const SeriesDescription& series, std::size_t frame) {
    std::ostringstream name;
    name << (series.name.empty() ? "samples" : series.name) << '.' << std::setw(4) << std::setfill('0')
         << frame;
    return name.str();
}

std::string heightsGridName(const SeriesDescription& series, std::size_t frame) {
    return gridName(series, frame) + ".heights";
}

std::string levelGridName(const std::string& name, int level) {
    return name + ".level" + std::to_string(level);
}

glm::bvec3 periodicAxes(const Lattice& lattice) {
    return {lattice.axes[0].period.has_value(), lattice.axes[1].period.has_value(),
            lattice.axes[2].period.has_value()};
}

std::vector<LevelRecord> addLevelGrids(const SeriesDescription& series, std::size_t frame,
                                       const KeyFrame& keyFrame, openvdb::GridPtrVec& grids) {
    std::vector<LevelRecord> records;
    for (int level = 1; level <= keyFrame.pyramid().top(); ++level) {
        const Lattice lattice = coarseLattice(series.lattice, level);
        // As it is read back: its tables may be smaller than those of the pyramid.
        const auto add = [&](const KeyFrame& whole, const std::string& name,
                             std::shared_ptr<const KeyFrame> heights) {
            const auto grid = nameGrid(makeSparseGrid(*whole.pyramid().level(level)),
                                       levelGridName(name, level), lattice, series.time.times[frame]);
            grids.push_back(grid);
            return makeKeyFrame(*grid, lattice.dims(), periodicAxes(lattice), true, std::move(heights));
        };
        LevelRecord record;
        std::shared_ptr<const KeyFrame> heights;
        if (keyFrame.heights()) {
            heights = add(*keyFrame.heights(), heightsGridName(series, frame), nullptr);
            record.heightsChecksum = checksum(*heights);
        }
        const auto coarse = add(keyFrame, gridName(series, frame), heights);
        record.checksum = checksum(*coarse);
        record.bytes = coarse->bytes();
        records.push_back(record);
    }
    return records;
}

void saveSeries(const SeriesDescription& series, const openvdb::GridPtrVec& grids, AtomicFile& file,
                const std::filesystem::path& out) {
    const std::string description = toJson(series);
    openvdb::MetaMap metadata;
    metadata.insertMeta(kDescriptionKey, openvdb::StringMetadata(description));
    try {
        openvdb::io::File(file.temporaryPath().string()).write(grids, metadata);
    } catch (const openvdb::Exception& failure) {
        throw Error(std::string("cannot write: ") + failure.what(), out.string());
    }
    stampIdentifier(file.temporaryPath(), out, description);
    sealFile(file.temporaryPath(), out);
    checkWritten(file.temporaryPath(), out);
    file.commit();
}

SeriesDescription writeSeries(FrameSource& source, const std::filesystem::path& out,
                              const SparsityOptions& options, const ImportProgress& progress) {
    openvdb::initialize();
    AtomicFile file(out);
    SeriesDescription series = source.description();
    requireUsable(series.lattice, series.provenance);
    series.name = asUtf8(series.name);  // names the grids, and is read back from the JSON text
    const glm::ivec3 dims = series.lattice.dims();
    series.storedError = options.tolerance;
    series.keep = options.keep;
    std::vector<float> samples(static_cast<std::size_t>(dims.x) * dims.y * dims.z);
    const auto fates = allFates(source, options, samples);

    std::optional<HeightsWriter> heights;
    if (series.lattice.heights) heights.emplace(series);

    openvdb::GridPtrVec grids;
    openvdb::GridPtrVec levelGrids;
    const std::size_t count = series.time.times.size();
    for (std::size_t i = 0; i < count; ++i) {
        source.read(i, samples);
        const auto grid = nameGrid(makeSparseGrid(dims, samples, options.tolerance, fates[i]),
                                   gridName(series, i), series.lattice, series.time.times[i]);
        grids.push_back(grid);
        std::shared_ptr<const KeyFrame> heightFrame;
        if (heights) heightFrame = heights->add(source, i, samples, grids);
        const auto keyFrame =
            makeKeyFrame(*grid, dims, periodicAxes(series.lattice), series.inactiveIsMissing, heightFrame);
        series.frames.push_back(describeFrame(*grid, *keyFrame, samples));
        if (options.levels) series.frames.back().levels = addLevelGrids(series, i, *keyFrame, levelGrids);
        if (progress) progress(i + 1, count);
    }
    if (heights) heights->finish(*series.lattice.heights);

    // The levels together: a slow disk need not seek between them.
    levelGrids.insert(levelGrids.end(), grids.begin(), grids.end());
    saveSeries(series, levelGrids, file, out);
    return series;
}

std::shared_ptr<const KeyFrame> makeKeyFrame(const Lattice& lattice, std::span<const float> samples,
                                             std::span<const float> heights) {
    const glm::ivec3 dims = lattice.dims();
    const glm::bvec3 periodic = periodicAxes(lattice);
    std::shared_ptr<const KeyFrame> heightFrame;
    if (!heights.empty()) heightFrame = makeKeyFrame(*makeSparseGrid(dims, heights, 0), dims, periodic, true);
    return makeKeyFrame(*makeSparseGrid(dims, samples, 0), dims, periodic, true, std::move(heightFrame));
}

}  // namespace isoglass
