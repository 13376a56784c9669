#include "volume/series_file.h"

#include "base/error.h"
#include "volume/checksum.h"
#include "volume/pyramid.h"
#include "volume/series_grids.h"
#include "volume/series_json.h"
#include "volume/series_seal.h"
#include "volume/sparse_grid.h"

#include <openvdb/io/File.h>

#include <algorithm>
#include <mutex>
#include <string>

namespace isoglass {

namespace {

/// An open file that one thread at a time reads.
struct Handle {
    std::mutex mutex;
    std::unique_ptr<openvdb::io::File> file;
};

}  // namespace

struct SeriesFile::Impl {
    std::filesystem::path path;
    SeriesDescription description;
    mutable Handle frames;
    mutable Handle levels;    ///< open where there are levels
    ReadFrame readElsewhere;  ///< takes the place of both
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

openvdb::FloatGrid::Ptr readGrid(Handle& handle, const std::string& name, const std::string& where) {
    openvdb::FloatGrid::Ptr grid;
    try {
        const std::scoped_lock lock(handle.mutex);
        grid = openvdb::gridPtrCast<openvdb::FloatGrid>(handle.file->readGrid(name));
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

SeriesFile::SeriesFile(const std::filesystem::path& path, Check check) : impl_(std::make_unique<Impl>()) {
    openvdb::initialize();
    const std::string where = path.string();
    if (!std::filesystem::exists(path)) throw Error("there is no such file", where);
    if (check == Check::whole) checkSeal(path);
    impl_->path = path;
    impl_->frames.file = std::make_unique<openvdb::io::File>(where);
    try {
        const std::string text = readDescription(*impl_->frames.file, where);
        impl_->description = seriesFromJson(text, where);
        const auto hasLevels = [](const FrameRecord& frame) { return !frame.levels.empty(); };
        if (std::ranges::any_of(impl_->description.frames, hasLevels)) {
            impl_->levels.file = std::make_unique<openvdb::io::File>(where);
            impl_->levels.file->open(/*delayLoad=*/false);
        }
    } catch (const openvdb::Exception& failure) {
        throw Error(std::string("not a readable OpenVDB file: ") + failure.what(), where,
                    "make one with 'isoglass import'");
    }
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

std::shared_ptr<const KeyFrame> SeriesFile::readLevel(std::size_t frame, int level) const {
    const SeriesDescription& series = impl_->description;
    std::string where = impl_->path.string() + ", key frame " + std::to_string(frame);
    if (frame >= series.frames.size()) throw Error("there is no such key frame", where);
    const FrameRecord& record = series.frames[frame];
    if (level > 0) where += ", level " + std::to_string(level);
    if (level < 0 || level > static_cast<int>(record.levels.size()))
        throw Error("the file does not hold this level", where, "import the series again");
    if (impl_->readElsewhere) return impl_->readElsewhere(frame, level);

    const LevelRecord whole{record.checksum, record.bytes, record.heightsChecksum};
    const LevelRecord& expected = level > 0 ? record.levels[level - 1] : whole;
    Handle& handle = level > 0 ? impl_->levels : impl_->frames;
    const Lattice lattice = coarseLattice(series.lattice, level);
    const glm::ivec3 dims = lattice.dims();
    const glm::bvec3 periodic = periodicAxes(lattice);
    const auto grid = [&](const std::string& name) {
        return readGrid(handle, level > 0 ? levelGridName(name, level) : name, where);
    };
    std::shared_ptr<const KeyFrame> heights;
    if (series.lattice.heights) {
        heights = makeKeyFrame(*grid(heightsGridName(series, frame)), dims, periodic,
                               /*inactiveIsMissing=*/true);
        requireChecksum(*heights, expected.heightsChecksum.value(), "heights", where);
    }
    const bool inactiveIsMissing = level > 0 || series.inactiveIsMissing;
    auto keyFrame =
        makeKeyFrame(*grid(gridName(series, frame)), dims, periodic, inactiveIsMissing, std::move(heights));
    requireChecksum(*keyFrame, expected.checksum, "samples", where);
    return keyFrame;
}

}  // namespace isoglass
