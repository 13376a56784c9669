#include "pipeline/scene_extractor.h"

#include "base/error.h"
#include "pipeline/scene_objects.h"
#include "render/camera.h"
#include "surface/level_values.h"
#include "surface/motion.h"
#include "surface/vertex_values.h"
#include "volume/pyramid.h"

#include <glm/common.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace isoglass {

namespace {

/// Intervals between key frames that are looked ahead.
constexpr int kMostAhead = 64;
/// Along its longest axis, a level that is shown in place of key frames has at least so many cells: a coarser
/// one tells nothing.
constexpr int kFewestCells = 32;

/// The planes that cut a volume, in its own coordinates.
std::vector<CutPlane> cutPlanes(const Scene& scene, const Volume& volume) {
    std::vector<CutPlane> planes;
    for (const ClipPlane& clip : volume.clip) planes.push_back({clip.plane, clip.cap});
    // plane . (M p) = (M^T plane) . p
    const glm::dmat4 seriesFromWorld = glm::transpose(worldFromSeries(volume.place));
    for (const ClipPlane& clip : scene.clip) planes.push_back({seriesFromWorld * clip.plane, clip.cap});
    return planes;
}

/// Whether one plane alone leaves nothing of a box.
bool isCutOff(const std::array<glm::dvec3, 2>& box, const std::vector<CutPlane>& planes) {
    return std::ranges::any_of(planes, [&box](const CutPlane& plane) {
        glm::dvec3 farthest;
        for (int k = 0; k < 3; ++k) farthest[k] = box[plane.plane[k] > 0 ? 1 : 0][k];
        return plane.distance(farthest) < 0;
    });
}

/// The finest level that rays can take. Throws where they cannot take the series.
int finestSampledLevel(const SeriesFile& series) {
    const SeriesDescription& description = series.description();
    const Lattice& lattice = description.lattice;
    const glm::ivec3 cells = lattice.cells();
    if (lattice.heights) {
        throw Error("rays go through samples on even levels, but this series has heights",
                    series.path().string(), "import it without --height, or remove \"style\"");
    }
    if (std::min({cells.x, cells.y, cells.z}) < 1) {
        throw Error("rays need at least two samples along each axis", series.path().string(),
                    "remove \"style\"");
    }
    const int level = DenseSamples::levelFor(lattice);
    for (const FrameRecord& frame : description.frames) {
        if (static_cast<int>(frame.levels.size()) >= level) continue;
        throw Error(
            "the series is too large for rays through it at full resolution, and coarser levels "
            "are not stored",
            series.path().string(), "import it again without --no-levels");
    }
    return level;
}

TimeSample sampleOf(const PlayedSeries& played, double position) {
    return locate(played.file->description().time, played.timeAt(position));
}

}  // namespace

std::vector<std::shared_ptr<const SurfaceMesh>> SceneMeshes::meshes() const {
    std::vector<std::shared_ptr<const SurfaceMesh>> all;
    for (const ExtractedSurface& extracted : surfaces) all.push_back(extracted.mesh);
    all.insert(all.end(), objects.begin(), objects.end());
    return all;
}

SceneExtractor::SceneExtractor(const Scene& scene, Options options)
    : scene_(scene), options_(std::move(options)) {
    for (const Volume& volume : scene_.volumes) {
        const auto file = options_.open(volume);
        checkGrid(volume, file->description());
        series_.push_back(playSeries(volume, scene_.time, file));
    }
    for (std::size_t v = 0; v < scene_.volumes.size(); ++v) {
        const Volume& volume = scene_.volumes[v];
        for (std::size_t s = 0; s < volume.surfaces.size(); ++s) {
            const auto& color = volume.surfaces[s].fieldColor;
            if (!color || color->by != FieldColor::By::series) continue;
            Volume source;
            source.name = volume.name;
            source.series = color->series;
            source.time = volume.time;
            colorSeries_.push_back({v, s, playSeries(source, scene_.time, options_.open(source))});
        }
    }
    for (const MeshObject& object : scene_.meshes) {
        ObjectMesh read = readObject(object);
        objects_.push_back(std::move(read.mesh));
        notes_.insert(notes_.end(), read.notes.begin(), read.notes.end());
    }
    sampled_ = sampledVolume(scene_);
    if (sampled_) finestSampled_ = finestSampledLevel(*series_[*sampled_].file);
    using enum KeyFrameCache::Frames;
    const auto frames = scene_.quality.errorPixels ? withErrors : scene_.quality.pixels ? withLevels : plain;
    cache_ = std::make_unique<KeyFrameCache>(files(), options_.memoryBytes, frames, options_.arrived);
    if (!cache_->fitsMomentWithLevels()) options_.patienceSeconds.reset();
}

std::vector<PlannedWork> SceneExtractor::planAt(std::size_t volume, const TimeSample& sample) const {
    VolumeState state;
    state.onKeyFrame = sample.fraction == 0;
    state.clippedAway = isCutOff(series_[volume].file->description().lattice.bounds(),
                                 cutPlanes(scene_, scene_.volumes[volume]));
    state.layered = scene_.layers && sampled_ == volume;
    state.shaded = scene_.shaded && sampled_ == volume;
    for (const Surface& surface : scene_.volumes[volume].surfaces) {
        state.surfaceOpacities.push_back(surface.shell ? 1.0f : surface.opacity);
    }
    return planVolume(state);
}

SceneExtractor::Moment SceneExtractor::momentAt(std::size_t series, const TimeSample& sample, bool first,
                                                bool second, int finest) {
    std::vector<std::size_t> frames;
    if (first) frames.push_back(sample.frameA);
    if (second) frames.push_back(sample.frameB);
    Moment moment;
    moment.level = levelNow(series, frames, finest);
    moment.lattice = coarseLattice(played(series).file->description().lattice, moment.level);
    if (first) moment.field.a = cache_->get({series, sample.frameA, moment.level});
    if (second) moment.field.b = cache_->get({series, sample.frameB, moment.level});
    moment.field.fraction = static_cast<float>(sample.fraction);
    return moment;
}

/// The level of all these frames that can be had in time.
int SceneExtractor::levelNow(std::size_t series, const std::vector<std::size_t>& frames, int finest) const {
    if (!options_.patienceSeconds) return finest;
    const SeriesDescription& description = played(series).file->description();
    // A level cuts a periodic axis open: colours end at the seam, and closed volumes would get walls there.
    const bool seamShows = series >= series_.size() || scene_.volumes[series].closed;
    const auto periodic = [](const Axis& axis) { return axis.period.has_value(); };
    if (seamShows && std::ranges::any_of(description.lattice.axes, periodic)) return finest;
    const glm::ivec3 cells = description.lattice.cells();
    int coarsest = 0;
    while (std::max({cells.x, cells.y, cells.z}) >> (coarsest + 1) >= kFewestCells) ++coarsest;
    for (const std::size_t frame : frames)
        coarsest = std::min(coarsest, static_cast<int>(description.frames[frame].levels.size()));
    for (int level = finest; level < coarsest; ++level) {
        double seconds = 0;
        for (const std::size_t frame : frames) seconds += cache_->expectedSeconds({series, frame, level});
        if (seconds <= *options_.patienceSeconds) return level;
    }
    return std::max(coarsest, finest);
}

const PlayedSeries& SceneExtractor::played(std::size_t series) const {
    return series < series_.size() ? series_[series] : colorSeries_[series - series_.size()].played;
}

/// The key frames that the scene needs at one moment.
std::vector<FrameKey> SceneExtractor::framesAt(double position) const {
    std::vector<FrameKey> keys;
    std::vector<std::vector<PlannedWork>> works;
    for (std::size_t volume = 0; volume < series_.size(); ++volume) {
        const TimeSample sample = sampleOf(series_[volume], position);
        works.push_back(planAt(volume, sample));
        const auto addBoth = [&](int level) {
            if (isNeeded(works.back(), WorkKind::firstKeyFrame))
                keys.push_back({volume, sample.frameA, level});
            if (isNeeded(works.back(), WorkKind::secondKeyFrame))
                keys.push_back({volume, sample.frameB, level});
        };
        const bool surfaces = std::ranges::any_of(works.back(), [](const PlannedWork& work) {
            return work.kind == WorkKind::extraction && work.needed;
        });
        if (surfaces) addBoth(0);
        if (isNeeded(works.back(), WorkKind::samples)) addBoth(finestSampled_);
    }
    for (std::size_t i = 0; i < colorSeries_.size(); ++i) {
        const ColorSeries& color = colorSeries_[i];
        if (!isNeeded(works[color.volume], WorkKind::extraction, color.surface)) continue;
        const TimeSample sample = sampleOf(color.played, position);
        keys.push_back({series_.size() + i, sample.frameA});
        if (sample.fraction > 0) keys.push_back({series_.size() + i, sample.frameB});
    }
    return keys;
}

/// Of any series.
double SceneExtractor::keyPositionBeyond(double position, bool forwards) const {
    double nearest = forwards ? 1 : 0;
    for (std::size_t i = 0; i < series_.size() + colorSeries_.size(); ++i) {
        const double found = isoglass::keyPositionBeyond(played(i), position, forwards);
        nearest = forwards ? std::min(nearest, found) : std::max(nearest, found);
    }
    return nearest;
}

/// Of displayed frames.
double SceneExtractor::shownPositionBeyond(double position, bool forwards) const {
    constexpr double kSame = 1e-9;
    const auto count = static_cast<double>(scene_.time.frameCount());
    const double beyond =
        forwards ? std::floor((position + kSame) * count) + 1 : std::ceil((position - kSame) * count) - 1;
    return std::clamp(beyond / count, 0.0, 1.0);
}

/// In the order in which they will be needed.
std::vector<FrameKey> SceneExtractor::framesAhead(double position, Course course) const {
    std::vector<FrameKey> keys;
    const auto add = [&](double at) {
        for (const FrameKey key : framesAt(at)) {
            if (std::ranges::find(keys, key) == keys.end()) keys.push_back(key);
        }
    };
    add(position);
    // Steps go to the next key frame, displayed or not.
    add(keyPositionBeyond(position, course.forwards));
    const double end = course.forwards ? 1 : 0;
    double at = position;
    bool looped = !course.loops;
    for (int i = 0; i < kMostAhead; ++i) {
        if (at == end) {
            add(end);
            if (looped) break;
            looped = true;
            at = 1 - end;
            add(at);
        }
        const double next = keyPositionBeyond(at, course.forwards);
        const double shown = shownPositionBeyond(at, course.forwards);
        if (std::abs(shown - at) > std::abs(next - at)) {
            // Key frames are denser than what is displayed: only those on either side of it are needed.
            add(shown);
            at = shown;
        } else {
            // In the middle of an interval both its ends are needed.
            add((at + next) / 2);
            at = next;
        }
    }
    return keys;
}

View SceneExtractor::viewOf(const Volume& volume, const CameraPose& camera, glm::ivec2 imageSize) const {
    View view;
    view.eye = glm::dvec3(glm::inverse(worldFromSeries(volume.place)) * glm::dvec4(camera.eye, 1.0));
    view.worldPerUnit = glm::abs(volume.place.scale);
    view.pixelsPerUnit = imageSize.y / (2 * std::tan(scene_.camera.fovDegrees * M_PI / 360));
    view.cellPixels = scene_.quality.pixels.value_or(0);
    view.errorPixels = scene_.quality.errorPixels.value_or(0);
    if (options_.seenMargin) {
        const CameraView picture{camera.eye, camera.target, scene_.camera.up, scene_.camera.fovDegrees,
                                 imageSize};
        // plane . (M p) = (M^T plane) . p
        const glm::dmat4 seriesFromWorld = glm::transpose(worldFromSeries(volume.place));
        for (const glm::dvec4& plane : viewPlanes(picture, *options_.seenMargin))
            view.planes.push_back(seriesFromWorld * plane);
    }
    return view;
}

std::vector<float> SceneExtractor::colorValues(const SurfaceMesh& mesh, const ExtractedSurface& place,
                                               const Moment& moment, const ExtractOptions& options,
                                               double position, int& substitute) {
    switch (scene_.volumes[place.volume].surfaces[place.surface].fieldColor->by) {
        case FieldColor::By::curvature:
            return meanCurvature(mesh);
        case FieldColor::By::value:
            return sampleAtVertices(mesh, moment.lattice, moment.field, options_.threads);
        case FieldColor::By::level: {
            std::vector<float> levels = levelAtVertices(mesh, moment.lattice, moment.field, options);
            for (float& level : levels) level += static_cast<float>(moment.level);
            return levels;
        }
        case FieldColor::By::series:
            break;
    }
    std::size_t index = 0;
    while (colorSeries_[index].volume != place.volume || colorSeries_[index].surface != place.surface)
        ++index;
    const TimeSample sample = sampleOf(colorSeries_[index].played, position);
    const Moment values = momentAt(series_.size() + index, sample, true, sample.fraction > 0);
    substitute = std::max(substitute, values.level);
    return sampleAtVertices(mesh, values.lattice, values.field, options_.threads);
}

std::vector<std::shared_ptr<const SeriesFile>> SceneExtractor::files() const {
    std::vector<std::shared_ptr<const SeriesFile>> all;
    for (const PlayedSeries& played : series_) all.push_back(played.file);
    for (const ColorSeries& color : colorSeries_) all.push_back(color.played.file);
    return all;
}

SceneMeshes SceneExtractor::extract(double position, const CameraPose& camera, glm::ivec2 imageSize,
                                    Course course) {
    const std::vector<FrameKey> ahead = framesAhead(position, course);
    cache_->want(ahead);
    SceneMeshes result;
    result.objects = objects_;
    for (std::size_t v = 0; v < scene_.volumes.size(); ++v) {
        const SeriesDescription& series = series_[v].file->description();
        const double time = series_[v].timeAt(position);
        result.bounds.push_back(series.lattice.bounds());
        result.axisTimes.push_back(time);
        result.times.push_back(locate(series.time, time));
        result.work.push_back(planAt(v, result.times.back()));
        if (options_.motion) {
            const double length = intervalLength(series.time, result.times.back());
            result.fractionsPerPosition.push_back(length > 0 ? (series_[v].to - series_[v].from) / length
                                                             : 0);
            result.motionLimits.push_back(motionLimit(series.lattice));
        }
        addSurfaces(v, position, viewOf(scene_.volumes[v], camera, imageSize), result);
        if (isNeeded(result.work.back(), WorkKind::samples)) addSamples(v, result);
    }
    // What was held here may have taken the room of what is to be read.
    cache_->want(ahead);
    return result;
}

void SceneExtractor::addSamples(std::size_t volume, SceneMeshes& result) {
    const TimeSample& sample = result.times[volume];
    const bool second = isNeeded(result.work[volume], WorkKind::secondKeyFrame);
    const Moment moment = momentAt(volume, sample, true, second, finestSampled_);
    const auto samplesOf = [&](std::size_t frame, const std::shared_ptr<const KeyFrame>& key) {
        return denseSamples_.of({volume, frame, moment.level}, *key, options_.threads);
    };
    SceneSamples samples;
    samples.volume = volume;
    samples.axes = sampleAxes(moment.lattice);
    samples.first = samplesOf(sample.frameA, moment.field.a);
    if (second) samples.second = samplesOf(sample.frameB, moment.field.b);
    samples.fraction = sample.fraction;
    for (const CutPlane& cut : cutPlanes(scene_, scene_.volumes[volume])) samples.planes.push_back(cut.plane);
    result.samples = std::move(samples);
    if (moment.level > finestSampled_)
        result.substitutes[volume] = std::max(result.substitutes[volume], moment.level);
}

void SceneExtractor::addSurfaces(std::size_t v, double position, View view, SceneMeshes& result) {
    const Volume& volume = scene_.volumes[v];
    const std::vector<PlannedWork>& work = result.work[v];
    const Moment moment = momentAt(v, result.times[v], isNeeded(work, WorkKind::firstKeyFrame),
                                   isNeeded(work, WorkKind::secondKeyFrame));
    const auto& [field, lattice, level] = moment;
    int& substitute = result.substitutes.emplace_back(level);
    // It is coarse as it is.
    if (level > 0) view.cellPixels = view.errorPixels = 0;
    for (std::size_t s = 0; s < volume.surfaces.size(); ++s) {
        const Surface& surface = volume.surfaces[s];
        if (!isNeeded(work, WorkKind::extraction, s)) {
            result.surfaces.push_back({v, s, std::make_shared<const SurfaceMesh>(), {}});
            continue;
        }
        const ExtractOptions options = optionsFor(volume, surface, view);
        Extraction extraction = extractSurface(lattice, field, options);
        const auto add = [&](SurfaceMesh mesh, const ExtractStats& stats, bool caps) {
            ExtractedSurface extracted{v, s, nullptr, stats, caps};
            if (surface.fieldColor)
                mesh.colorValues = colorValues(mesh, extracted, moment, options, position, substitute);
            extracted.mesh = std::make_shared<const SurfaceMesh>(std::move(mesh));
            result.surfaces.push_back(std::move(extracted));
        };
        // Cuts stay where they are.
        if (options_.motion && options.clip.empty() && !options.closed)
            extraction.mesh.velocities = normalVelocities(extraction.mesh, lattice, field, options);
        add(std::move(extraction.mesh), extraction.stats, false);
        if (!extraction.caps.empty()) add(std::move(extraction.caps), {}, true);
    }
}

ExtractOptions SceneExtractor::optionsFor(const Volume& volume, const Surface& surface,
                                          const View& view) const {
    ExtractOptions options{.iso = static_cast<float>(surface.iso),
                           .insideIsBelow = surface.inside == Inside::below,
                           .view = view,
                           .still = scene_.time.frameCount() == 1,
                           .threads = options_.threads,
                           .clip = cutPlanes(scene_, volume),
                           .closed = volume.closed};
    // Curvature looks at all triangles around a vertex.
    if (surface.fieldColor && surface.fieldColor->by == FieldColor::By::curvature)
        options.view->planes.clear();
    return options;
}

}  // namespace isoglass
