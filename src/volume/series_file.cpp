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

SeriesFile::~SeriesFile() = default;

const SeriesDescription& SeriesFile::description() const {
    return impl_->description;
}

const std::filesystem::path& SeriesFile::path() const {
    return impl_->path;
}

std::shared_ptr<const KeyFrame> SeriesFile::read(std::size_t frame) const {
    const SeriesDescription& series = impl_->description;
    const std::string where = impl_->path.string() + ", key frame " + std::to_string(frame);
    openvdb::FloatGrid::Ptr grid;
    try {
        const std::scoped_lock lock(impl_->mutex);
        grid = openvdb::gridPtrCast<openvdb::FloatGrid>(impl_->file->readGrid(gridName(series, frame)));
    } catch (const std::exception& failure) {
        throw Error(std::string("cannot read the samples: ") + failure.what(), where,
                    "import the series again");
    }
    if (!grid) throw Error("the grid is missing or holds no floats", where, "import the series again");
    auto keyFrame =
        makeKeyFrame(*grid, series.lattice.dims(), periodicAxes(series.lattice), series.inactiveIsMissing);
    if (checksum(*keyFrame) != series.frames[frame].checksum) {
        throw Error("the samples are damaged: their checksum is not the one in the description", where,
                    "import the series again");
    }
    return keyFrame;
}

}  // namespace isoglass
