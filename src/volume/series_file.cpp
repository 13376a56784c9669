#include "volume/series_file.h"

#include "base/error.h"
#include "volume/checksum.h"
#include "volume/series_grids.h"
#include "volume/series_json.h"
#include "volume/series_seal.h"
#include "volume/sparse_grid.h"

#include <openvdb/io/File.h>

#include <mutex>
#include <string>

namespace isoglass {

struct SeriesFile::Impl {
    std::filesystem::path path;
    SeriesDescription description;
    mutable std::mutex mutex;
    std::unique_ptr<openvdb::io::File> file;
    ReadFrame readElsewhere;  ///< takes the place of `file`
};

namespace {

std::string readDescription(openvdb::io::File& file, const std::string& where) {
    // Delayed loading would read samples later, on whichever thread touches them first.
    file.open(/*delayLoad=*/false);
    const auto metadata = file.getMetadata();
    const auto text = metadata->getMetadata<openvdb::StringMetadata>(kDescriptionKey);
    if (!text) {
        throw Error("this OpenVDB file holds no IsoGlass series", where, "make one with 'isoglass import'");
    }
    return text->value();
}

openvdb::FloatGrid::Ptr readGrid(openvdb::io::File& file, std::mutex& mutex, const std::string& name,
                                 const std::string& where) {
    openvdb::FloatGrid::Ptr grid;
    try {
        const std::scoped_lock lock(mutex);
        grid = openvdb::gridPtrCast<openvdb::FloatGrid>(file.readGrid(name));
    } catch (const std::exception& failure) {
        throw Error(std::string("cannot read the samples: ") + failure.what(), where,
                    "import the series again");
    }
    if (!grid) throw Error("the grid is missing or holds no floats", where, "import the series again");
    return grid;
}

void requireChecksum(const KeyFrame& frame, std::uint32_t expected, const std::string& what,
                     const std::string& where) {
    if (checksum(frame) == expected) return;
    throw Error("the " + what + " are damaged: their checksum is not the one in the description", where,
                "import the series again");
}

}  // namespace

SeriesFile::SeriesFile(const std::filesystem::path& path) : impl_(std::make_unique<Impl>()) {
    openvdb::initialize();
    const std::string where = path.string();
    if (!std::filesystem::exists(path)) throw Error("there is no such file", where);
    checkSeal(path);
    impl_->path = path;
    impl_->file = std::make_unique<openvdb::io::File>(where);
    std::string text;
    try {
        text = readDescription(*impl_->file, where);
    } catch (const openvdb::Exception& failure) {
        throw Error(std::string("not a readable OpenVDB file: ") + failure.what(), where,
                    "make one with 'isoglass import'");
    }
    impl_->description = seriesFromJson(text, where);
}

SeriesFile::SeriesFile(std::filesystem::path name, SeriesDescription description, ReadFrame read)
    : impl_(std::make_unique<Impl>()) {
    impl_->path = std::move(name);
    impl_->description = std::move(description);
    impl_->readElsewhere = std::move(read);
}

SeriesFile::~SeriesFile() = default;

const SeriesDescription& SeriesFile::description() const {
    return impl_->description;
}

const std::filesystem::path& SeriesFile::path() const {
    return impl_->path;
}

std::shared_ptr<const KeyFrame> SeriesFile::read(std::size_t frame) const {
    if (impl_->readElsewhere) return impl_->readElsewhere(frame);
    const SeriesDescription& series = impl_->description;
    const std::string where = impl_->path.string() + ", key frame " + std::to_string(frame);
    const glm::ivec3 dims = series.lattice.dims();
    const glm::bvec3 periodic = periodicAxes(series.lattice);
    std::shared_ptr<const KeyFrame> heights;
    if (series.lattice.heights) {
        const auto grid = readGrid(*impl_->file, impl_->mutex, heightsGridName(series, frame), where);
        heights = makeKeyFrame(*grid, dims, periodic, /*inactiveIsMissing=*/true);
        requireChecksum(*heights, series.frames[frame].heightsChecksum.value(), "heights", where);
    }
    const auto grid = readGrid(*impl_->file, impl_->mutex, gridName(series, frame), where);
    auto keyFrame = makeKeyFrame(*grid, dims, periodic, series.inactiveIsMissing, std::move(heights));
    requireChecksum(*keyFrame, series.frames[frame].checksum, "samples", where);
    return keyFrame;
}

}  // namespace isoglass
