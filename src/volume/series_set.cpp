#include "volume/series_set.h"

#include "base/error.h"

#include <fnmatch.h>

#include <algorithm>
#include <charconv>
#include <string>
#include <utility>
#include <vector>

namespace isoglass {

namespace {

using Path = std::filesystem::path;

/// The files that a name or pattern means, in the order of their names.
std::vector<Path> filesOf(const Path& name) {
    const std::string pattern = name.filename().string();
    if (pattern.find_first_of("*?") == std::string::npos) return {name};
    const Path folder = name.has_parent_path() ? name.parent_path() : Path(".");
    std::error_code failure;
    std::vector<Path> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder, failure)) {
        const Path file = entry.path().filename();
        if (::fnmatch(pattern.c_str(), file.c_str(), FNM_PERIOD) == 0)
            files.push_back(name.parent_path() / file);
    }
    if (failure) throw Error("cannot look into the folder: " + failure.message(), folder.string());
    if (files.empty()) throw Error("no file has such a name", name.string());
    std::ranges::sort(files);
    return files;
}

std::string numeral(double value) {
    std::string text(32, ' ');
    text.resize(std::to_chars(text.data(), text.data() + text.size(), value).ptr - text.data());
    return text;
}

bool sameAxis(const Axis& a, const Axis& b) {
    return a.units == b.units && a.coordinates == b.coordinates && a.period == b.period;
}

/// What keeps two series from being one; empty where nothing does.
std::string difference(const SeriesDescription& a, const SeriesDescription& b) {
    if (a.name != b.name) return "holds '" + b.name + "', not '" + a.name + "'";
    if (a.units != b.units) return "has the units '" + b.units + "', not '" + a.units + "'";
    for (std::size_t k = 0; k < 3; ++k) {
        if (!sameAxis(a.lattice.axes[k], b.lattice.axes[k]))
            return std::string("has another ") + "xyz"[k] + " axis";
    }
    if (a.lattice.heights.has_value() != b.lattice.heights.has_value())
        return "has heights where the other has none, or the other way round";
    if (a.time.units != b.time.units || a.time.calendar != b.time.calendar)
        return "has times in '" + b.time.units + "', not in '" + a.time.units + "'";
    if (a.time.period != b.time.period) return "repeats after another time";
    return {};
}

/// One key frame of the whole.
struct Place {
    std::size_t file;
    std::size_t frame;
};

/// Changes where a file is written to.
struct Stamp {
    std::uintmax_t size = 0;
    std::filesystem::file_time_type modified;

    explicit Stamp(const Path& path) {
        std::error_code ignored;
        size = std::filesystem::file_size(path, ignored);
        modified = std::filesystem::last_write_time(path, ignored);
    }
    friend bool operator==(const Stamp&, const Stamp&) = default;
};

struct OpenedFile {
    Path path;
    Stamp stamp;  ///< before it was checked
    SeriesDescription description;
    std::shared_ptr<const SeriesFile> kept;  ///< null where it is opened for every read
};

void add(ValueRange keep, SeriesDescription& whole) {
    if (!whole.keep) whole.keep = keep;
    whole.keep = ValueRange{std::max(whole.keep->min, keep.min), std::min(whole.keep->max, keep.max)};
}

/// The description of all files together, and where each key frame lies.
std::pair<SeriesDescription, std::vector<Place>> join(const std::vector<OpenedFile>& files) {
    std::vector<Place> places;
    for (std::size_t f = 0; f < files.size(); ++f) {
        for (std::size_t i = 0; i < files[f].description.frames.size(); ++i) places.push_back({f, i});
    }
    const auto timeOf = [&](Place place) { return files[place.file].description.time.times[place.frame]; };
    std::ranges::stable_sort(places, {}, timeOf);
    SeriesDescription whole = files[0].description;
    whole.time.times.clear();
    whole.frames.clear();
    whole.keep.reset();
    for (std::size_t i = 0; i < places.size(); ++i) {
        if (i > 0 && timeOf(places[i]) == timeOf(places[i - 1])) {
            throw Error("has a key frame at time " + numeral(timeOf(places[i])) + ", and so has " +
                            files[places[i - 1].file].path.string(),
                        files[places[i].file].path.string(),
                        "give every file its own time: isoglass import --times, or leave one out");
        }
        const SeriesDescription& part = files[places[i].file].description;
        whole.time.times.push_back(timeOf(places[i]));
        whole.frames.push_back(part.frames[places[i].frame]);
        whole.storedError = std::max(whole.storedError, part.storedError);
        if (part.keep) add(*part.keep, whole);
        if (whole.lattice.heights) {
            whole.lattice.heights->min = std::min(whole.lattice.heights->min, part.lattice.heights->min);
            whole.lattice.heights->max = std::max(whole.lattice.heights->max, part.lattice.heights->max);
        }
    }
    if (whole.time.period && whole.time.times.back() - whole.time.times.front() >= *whole.time.period)
        throw Error("the times of all files together are longer than the period after which they repeat",
                    files[0].path.string());
    return {std::move(whole), std::move(places)};
}

std::shared_ptr<const KeyFrame> readFrom(const OpenedFile& file, std::size_t frame, int level) {
    if (file.kept) return file.kept->readLevel(frame, level);
    const bool same = Stamp(file.path) == file.stamp;
    const SeriesFile opened(file.path, same ? SeriesFile::Check::description : SeriesFile::Check::whole);
    const std::vector<FrameRecord>& frames = opened.description().frames;
    if (frames.size() != file.description.frames.size() ||
        frames[frame].checksum != file.description.frames[frame].checksum) {
        throw Error("the file has changed since it was opened", file.path.string());
    }
    return opened.readLevel(frame, level);
}

}  // namespace

std::shared_ptr<const SeriesFile> openSeriesSet(std::span<const Path> names) {
    std::vector<Path> paths;
    for (const Path& name : names) {
        for (Path& file : filesOf(name)) paths.push_back(std::move(file));
    }
    if (paths.size() == 1) return std::make_shared<SeriesFile>(paths[0]);
    auto files = std::make_shared<std::vector<OpenedFile>>();
    for (const Path& path : paths) {
        const Stamp stamp(path);
        auto opened = std::make_shared<const SeriesFile>(path);
        const SeriesDescription& description = opened->description();
        if (!files->empty()) {
            const std::string unlike = difference(files->front().description, description);
            if (!unlike.empty()) {
                throw Error("cannot be one series with " + files->front().path.string() + ": it " + unlike,
                            path.string());
            }
        }
        const bool keep = description.frames.size() > 1;
        files->push_back({path, stamp, description, keep ? opened : nullptr});
    }
    auto [whole, places] = join(*files);
    return std::make_shared<SeriesFile>(
        names[0], std::move(whole), [files, places = std::move(places)](std::size_t frame, int level) {
            return readFrom((*files)[places[frame].file], places[frame].frame, level);
        });
}

}  // namespace isoglass
