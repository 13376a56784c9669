#include "app/problems.h"

#include "app/text.h"
#include "pipeline/played_series.h"
#include "pipeline/scene_objects.h"
#include "scene/scene_check.h"
#include "scene/scene_file.h"

#include <algorithm>
#include <limits>
#include <set>
#include <utility>

namespace isoglass {

namespace {

using Severity = Problem::Severity;

/// Places read "FILE", "FILE, /POINTER" or "FILE, MORE".
Problem fromError(const Error& error, const std::string& file) {
    Problem problem{.what = error.problem(), .file = error.where(), .hint = error.hint()};
    if (!error.where().starts_with(file + ", ")) return problem;
    const std::string rest = error.where().substr(file.size() + 2);
    problem.file = file;
    (rest.starts_with('/') ? problem.pointer : problem.place) = rest;
    return problem;
}

/// What the checksums of its key frames say against a series.
std::vector<Error> damagedFrames(const SeriesFile& series) {
    std::vector<Error> errors;
    const std::vector<FrameRecord>& frames = series.description().frames;
    for (std::size_t i = 0; i < frames.size(); ++i) {
        for (int level = 0; level <= static_cast<int>(frames[i].levels.size()); ++level) {
            try {
                series.readLevel(i, level);
            } catch (const Error& error) {
                errors.push_back(error);
            }
        }
    }
    return errors;
}

/// Checks the volumes and meshes of a scene against their files.
class FileChecks {
  public:
    FileChecks(std::string sceneFile, const SceneProblems& scene, std::vector<Problem>& problems)
        : sceneFile_(std::move(sceneFile)), scene_(scene), problems_(problems) {}

    void check(std::size_t index) {
        const Volume& volume = scene_.rest->volumes[index];
        pointer_ = "/volumes/" + std::to_string(index);
        if (!scene_.touches(pointer_ + "/series")) checkSeries(volume);
        for (std::size_t i = 0; i < volume.surfaces.size(); ++i) checkColor(volume, i);
    }

    void checkMesh(std::size_t index) {
        const std::string pointer = "/meshes/" + std::to_string(index) + "/file";
        if (scene_.touches(pointer)) return;
        try {
            for (const std::string& note : readObject(scene_.rest->meshes[index]).notes)
                add(pointer, note, {}, Severity::warning);
        } catch (const Error& error) {
            add(pointer, error);
        }
    }

  private:
    /// Key frames that are shown, both ends included.
    struct Shown {
        std::size_t first;
        std::size_t last;
    };

    void checkSeries(const Volume& volume) {
        const std::shared_ptr<const SeriesFile> file = openAt(pointer_ + "/series", volume);
        if (!file) return;
        const SeriesDescription& series = file->description();
        try {
            checkGrid(volume, series);
        } catch (const Error& error) {
            add(pointer_ + "/grid", error);
        }
        checkSurfaces(volume, series, checkTimes(volume, file));
    }

    void checkColor(const Volume& volume, std::size_t surface) {
        const auto& color = volume.surfaces[surface].fieldColor;
        const std::string place = pointer_ + "/surfaces/" + std::to_string(surface) + "/color";
        if (!color || color->by != FieldColor::By::series || scene_.touches(place)) return;
        Volume source;
        source.series = color->series;
        openAt(place + "/series", source);
    }

    /// The series with every key frame read once; null where it cannot be opened.
    std::shared_ptr<const SeriesFile> openAt(const std::string& pointer, const Volume& volume) {
        std::shared_ptr<const SeriesFile> file;
        try {
            file = openSeries(volume);
        } catch (const Error& error) {
            add(pointer, error);
            return nullptr;
        }
        if (!read_.emplace(volume.series, volume.moreSeries).second) return file;
        for (const Error& error : damagedFrames(*file)) add(pointer, error);
        return file;
    }

    /// Names the place of the error, which is in another file, beside that in the scene.
    void add(const std::string& pointer, const Error& error) {
        add(pointer, error.problem() + " (" + error.where() + ")", error.hint());
    }

    void add(const std::string& pointer, const std::string& what, const std::string& hint = {},
             Severity severity = Severity::error) {
        problems_.push_back(
            {.severity = severity, .what = what, .file = sceneFile_, .pointer = pointer, .hint = hint});
    }

    Shown checkTimes(const Volume& volume, const std::shared_ptr<const SeriesFile>& file) {
        const TimeAxis& axis = file->description().time;
        const Shown all{0, axis.times.size() - 1};
        if (scene_.touches("/time") || scene_.touches(pointer_ + "/time")) return all;
        PlayedSeries played;
        try {
            played = playSeries(volume, scene_.rest->time, file);
        } catch (const Error& error) {
            add("/time", "volume '" + volume.name + "': " + error.problem() + " (" + error.where() + ")",
                error.hint());
            return all;
        }
        const auto [from, to] = std::minmax(played.from, played.to);
        const TimeSample first = locate(axis, from);
        const TimeSample last = locate(axis, to);
        if (first.where != TimeSample::Where::inside || last.where != TimeSample::Where::inside) {
            add("/time",
                "volume '" + volume.name + "' plays times from " + formatNumber(from) + " to " +
                    formatNumber(to) + ", but has key frames from " + formatNumber(axis.times.front()) +
                    " to " + formatNumber(axis.times.back()) + " (" + axis.units + ")",
                "beyond them the nearest key frame is shown", Severity::warning);
        }
        if (axis.period) return all;
        return {first.frameA, last.frameB};
    }

    void checkSurfaces(const Volume& volume, const SeriesDescription& series, Shown shown) {
        ValueRange range{std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity()};
        for (std::size_t i = shown.first; i <= shown.last; ++i) {
            range.min = std::min(range.min, series.frames[i].range.min);
            range.max = std::max(range.max, series.frames[i].range.max);
        }
        for (std::size_t i = 0; i < volume.surfaces.size(); ++i) {
            const std::string place = pointer_ + "/surfaces/" + std::to_string(i) + "/iso";
            const double iso = volume.surfaces[i].iso;
            if (scene_.touches(place)) continue;
            if (range.min > range.max) {
                add(place, "every sample is missing: the surface is empty", {}, Severity::warning);
            } else if (iso < range.min || iso > range.max) {
                add(place,
                    "the surface is always empty: the iso-value is " + formatNumber(iso) +
                        ", but the field is from " + formatNumber(range.min) + " to " +
                        formatNumber(range.max),
                    "choose a value in between", Severity::warning);
            } else if (series.keep && (iso < series.keep->min || iso > series.keep->max)) {
                add(place,
                    "the series was imported for iso-values from " + formatNumber(series.keep->min) + " to " +
                        formatNumber(series.keep->max) + " only: this surface is wrong in places",
                    "import it with another --keep", Severity::warning);
            }
        }
    }

    std::string sceneFile_;
    const SceneProblems& scene_;
    std::vector<Problem>& problems_;
    std::string pointer_;
    /// Series whose key frames were read.
    std::set<std::pair<std::filesystem::path, std::vector<std::filesystem::path>>> read_;
};

}  // namespace

std::vector<Problem> problemsOfScene(const std::filesystem::path& file) {
    const std::string name = file.string();
    std::vector<Problem> problems;
    SceneProblems scene;
    try {
        scene = checkScene(readSceneText(file), file.parent_path(), name);
    } catch (const Error& error) {
        problems.push_back(fromError(error, name));
        return problems;
    }
    for (const Error& error : scene.errors) problems.push_back(fromError(error, name));
    if (!scene.rest) return problems;
    for (const std::string& note : scene.rest->notes)
        problems.push_back({.severity = Severity::warning, .what = note, .file = name});
    FileChecks checks(name, scene, problems);
    for (std::size_t i = 0; i < scene.rest->volumes.size(); ++i) checks.check(i);
    for (std::size_t i = 0; i < scene.rest->meshes.size(); ++i) checks.checkMesh(i);
    return problems;
}

std::vector<Problem> problemsOfSeries(const std::filesystem::path& file) {
    std::vector<Problem> problems;
    try {
        for (const Error& error : damagedFrames(SeriesFile(file)))
            problems.push_back(fromError(error, file.string()));
    } catch (const Error& error) {
        problems.push_back(fromError(error, file.string()));
    }
    return problems;
}

}  // namespace isoglass
