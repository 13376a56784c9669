#include "pipeline/scene_extractor.h"

#include "render/camera.h"
#include "surface/level_values.h"
#include "surface/motion.h"
#include "surface/vertex_values.h"

#include <glm/common.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace isoglass {

namespace {

/// Steps into which what is left of the timeline is cut to find the key frames ahead.
constexpr int kLookAheadSteps = 64;

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

TimeSample sampleOf(const PlayedSeries& played, double position) {
    return locate(played.file->description().time, played.timeAt(position));
}

}  // namespace

SceneExtractor::SceneExtractor(const Scene& scene, Options options) : scene_(scene), options_(options) {
    for (const Volume& volume : scene_.volumes) {
        const auto file = openSeries(volume);
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
            colorSeries_.push_back({v, s, playSeries(source, scene_.time, openSeries(source))});
        }
    }
    using enum KeyFrameCache::Frames;
    const auto frames = scene_.quality.errorPixels ? withErrors : scene_.quality.pixels ? withLevels : plain;
    cache_ = std::make_unique<KeyFrameCache>(files(), options_.memoryBytes, frames);
}

std::vector<PlannedWork> SceneExtractor::planAt(std::size_t volume, const TimeSample& sample) const {
    VolumeState state;
    state.onKeyFrame = sample.fraction == 0;
    state.clippedAway = isCutOff(series_[volume].file->description().lattice.bounds(),
                                 cutPlanes(scene_, scene_.volumes[volume]));
    for (const Surface& surface : scene_.volumes[volume].surfaces) {
        state.surfaceOpacities.push_back(surface.shell ? 1.0f : surface.opacity);
    }
    return planVolume(state);
}

TimedField SceneExtractor::fieldAt(std::size_t series, const TimeSample& sample, bool first, bool second) {
    TimedField field;
    if (first) field.a = cache_->get({series, sample.frameA});
    if (second) field.b = cache_->get({series, sample.frameB});
    field.fraction = static_cast<float>(sample.fraction);
    return field;
}

std::vector<FrameKey> SceneExtractor::framesAhead(double position) const {
    std::vector<FrameKey> keys;
    const auto add = [&keys](FrameKey key) {
        if (std::find(keys.begin(), keys.end(), key) == keys.end()) keys.push_back(key);
    };
    for (int step = 0; step <= kLookAheadSteps; ++step) {
        const double at = position + (1 - position) * step / kLookAheadSteps;
        const auto addBoth = [&](std::size_t series, const TimeSample& sample, bool first, bool second) {
            if (first) add({series, sample.frameA});
            if (second) add({series, sample.frameB});
        };
        std::vector<std::vector<PlannedWork>> works;
        for (std::size_t volume = 0; volume < series_.size(); ++volume) {
            const TimeSample sample = sampleOf(series_[volume], at);
            works.push_back(planAt(volume, sample));
            addBoth(volume, sample, isNeeded(works.back(), WorkKind::firstKeyFrame),
                    isNeeded(works.back(), WorkKind::secondKeyFrame));
        }
        for (std::size_t i = 0; i < colorSeries_.size(); ++i) {
            const ColorSeries& color = colorSeries_[i];
            if (!isNeeded(works[color.volume], WorkKind::extraction, color.surface)) continue;
            const TimeSample sample = sampleOf(color.played, at);
            addBoth(series_.size() + i, sample, true, sample.fraction > 0);
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
                                               const TimedField& field, const ExtractOptions& options,
                                               double position) {
    switch (scene_.volumes[place.volume].surfaces[place.surface].fieldColor->by) {
        case FieldColor::By::curvature:
            return meanCurvature(mesh);
        case FieldColor::By::value:
            return sampleAtVertices(mesh, series_[place.volume].file->description().lattice, field,
                                    options_.threads);
        case FieldColor::By::level:
            return levelAtVertices(mesh, series_[place.volume].file->description().lattice, field, options);
        case FieldColor::By::series:
            break;
    }
    std::size_t index = 0;
    while (colorSeries_[index].volume != place.volume || colorSeries_[index].surface != place.surface)
        ++index;
    const PlayedSeries& source = colorSeries_[index].played;
    const TimeSample sample = sampleOf(source, position);
    const TimedField values = fieldAt(series_.size() + index, sample, true, sample.fraction > 0);
    return sampleAtVertices(mesh, source.file->description().lattice, values, options_.threads);
}

std::vector<std::shared_ptr<const SeriesFile>> SceneExtractor::files() const {
    std::vector<std::shared_ptr<const SeriesFile>> all;
    for (const PlayedSeries& played : series_) all.push_back(played.file);
    for (const ColorSeries& color : colorSeries_) all.push_back(color.played.file);
    return all;
}

SceneMeshes SceneExtractor::extract(double position, const CameraPose& camera, glm::ivec2 imageSize) {
    cache_->want(framesAhead(position));
    SceneMeshes result;
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
    }
    return result;
}

void SceneExtractor::addSurfaces(std::size_t v, double position, const View& view, SceneMeshes& result) {
    const Volume& volume = scene_.volumes[v];
    const Lattice& lattice = series_[v].file->description().lattice;
    const std::vector<PlannedWork>& work = result.work[v];
    const TimedField field = fieldAt(v, result.times[v], isNeeded(work, WorkKind::firstKeyFrame),
                                     isNeeded(work, WorkKind::secondKeyFrame));
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
            if (surface.fieldColor) mesh.colorValues = colorValues(mesh, extracted, field, options, position);
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
