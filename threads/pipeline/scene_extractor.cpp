#include "pipeline/scene_extractor.h"

#include <glm/common.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>

namespace isoglass {

namespace {

/// Steps into which what is left of the timeline is cut to find the key frames ahead.
constexpr int kLookAheadSteps = 64;

}  // namespace

SceneExtractor::SceneExtractor(const Scene& scene, Options options) : scene_(scene), options_(options) {
    std::vector<std::shared_ptr<const SeriesFile>> files;
    for (const Volume& volume : scene_.volumes) {
        files.push_back(openSeries(volume));
        checkGrid(volume, files.back()->description());
        series_.push_back(playSeries(volume, scene_.time, files.back()));
    }
    const auto frames =
        scene_.quality.pixels ? KeyFrameCache::Frames::withLevels : KeyFrameCache::Frames::plain;
    cache_ = std::make_unique<KeyFrameCache>(std::move(files), options_.memoryBytes, frames);
}

std::vector<PlannedWork> SceneExtractor::planAt(std::size_t volume, const TimeSample& sample) const {
    VolumeState state;
    state.onKeyFrame = sample.fraction == 0;
    for (const Surface& surface : scene_.volumes[volume].surfaces) {
        state.surfaceOpacities.push_back(surface.opacity);
    }
    return planVolume(state);
}

TimedField SceneExtractor::fieldAt(std::size_t volume, const TimeSample& sample,
                                   const std::vector<PlannedWork>& work) {
    TimedField field;
    if (isNeeded(work, WorkKind::firstKeyFrame)) field.a = cache_->get({volume, sample.frameA});
    if (isNeeded(work, WorkKind::secondKeyFrame)) field.b = cache_->get({volume, sample.frameB});
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
        for (std::size_t volume = 0; volume < series_.size(); ++volume) {
            const TimeSample sample =
                locate(series_[volume].file->description().time, series_[volume].timeAt(at));
            const std::vector<PlannedWork> work = planAt(volume, sample);
            if (isNeeded(work, WorkKind::firstKeyFrame)) add({volume, sample.frameA});
            if (isNeeded(work, WorkKind::secondKeyFrame)) add({volume, sample.frameB});
        }
    }
    return keys;
}

View SceneExtractor::viewOf(const Volume& volume, const CameraPose& camera, int imageHeight) const {
    View view;
    view.eye = glm::dvec3(glm::inverse(worldFromSeries(volume.place)) * glm::dvec4(camera.eye, 1.0));
    view.worldPerUnit = glm::abs(volume.place.scale);
    view.pixelsPerUnit = imageHeight / (2 * std::tan(scene_.camera.fovDegrees * M_PI / 360));
    view.cellPixels = scene_.quality.pixels.value_or(0);
    return view;
}

SceneMeshes SceneExtractor::extract(double position, const CameraPose& camera, int imageHeight) {
    cache_->want(framesAhead(position));
    SceneMeshes result;
    for (std::size_t v = 0; v < scene_.volumes.size(); ++v) {
        const Volume& volume = scene_.volumes[v];
        const SeriesDescription& series = series_[v].file->description();
        const double time = series_[v].timeAt(position);
        result.axisTimes.push_back(time);
        result.times.push_back(locate(series.time, time));
        result.work.push_back(planAt(v, result.times.back()));
        const std::vector<PlannedWork>& work = result.work.back();
        const TimedField field = fieldAt(v, result.times.back(), work);
        const View view = viewOf(volume, camera, imageHeight);
        for (std::size_t s = 0; s < volume.surfaces.size(); ++s) {
            const Surface& surface = volume.surfaces[s];
            if (!isNeeded(work, WorkKind::extraction, s)) {
                result.surfaces.push_back({v, s, std::make_shared<const SurfaceMesh>(), {}});
                continue;
            }
            Extraction extraction = extractSurface(series.lattice, field,
                                                   {.iso = static_cast<float>(surface.iso),
                                                    .insideIsBelow = surface.inside == Inside::below,
                                                    .view = view,
                                                    .threads = options_.threads});
            auto mesh = std::make_shared<const SurfaceMesh>(std::move(extraction.mesh));
            result.surfaces.push_back({v, s, std::move(mesh), extraction.stats});
        }
    }
    return result;
}

}  // namespace isoglass
