#include "base/atomic_file.h"
#include "base/error.h"
#include "basis/parallel.h"
#include "volume/brick_fates.h"
#include "volume/checksum.h"
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
        for (std::size_t i = 0; i < file.description().frames.size(); ++i) file.read(i);
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

}  // namespace

std::string gridName(const SeriesDescription& series, std::size_t frame) {
    std::ostringstream name;
    name << (series.name.empty() ? "samples" : series.name) << '.' << std::setw(4) << std::setfill('0')
         << frame;
    return name.str();
}

glm::bvec3 periodicAxes(const Lattice& lattice) {
    return {lattice.axes[0].period.has_value(), lattice.axes[1].period.has_value(),
            lattice.axes[2].period.has_value()};
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
    series.name = asUtf8(series.name);  // names the grids, and is read back from the JSON text
    const glm::ivec3 dims = series.lattice.dims();
    series.storedError = options.tolerance;
    series.keep = options.keep;
    std::vector<float> samples(static_cast<std::size_t>(dims.x) * dims.y * dims.z);
    const auto fates = allFates(source, options, samples);

    openvdb::GridPtrVec grids;
    const std::size_t count = series.time.times.size();
    for (std::size_t i = 0; i < count; ++i) {
        source.read(i, samples);
        auto grid = makeSparseGrid(dims, samples, options.tolerance, fates[i]);
        grid->setName(gridName(series, i));
        grid->setTransform(transformOf(series.lattice));
        grid->insertMeta("isoglass.time", openvdb::DoubleMetadata(series.time.times[i]));
        const auto keyFrame =
            makeKeyFrame(*grid, dims, periodicAxes(series.lattice), series.inactiveIsMissing);
        series.frames.push_back(describeFrame(*grid, *keyFrame, samples));
        grids.push_back(grid);
        if (progress) progress(i + 1, count);
    }

    saveSeries(series, grids, file, out);
    return series;
}

std::shared_ptr<const KeyFrame> makeKeyFrame(const Lattice& lattice, std::span<const float> samples) {
    return makeKeyFrame(*makeSparseGrid(lattice.dims(), samples, 0), lattice.dims(), periodicAxes(lattice),
                        true);
}

}  // namespace isoglass
