#include "app/view/first_scene.h"

#include "app/text.h"
#include "app/view/camera_control.h"
#include "base/error.h"
#include "pipeline/scene_objects.h"
#include "volume/calendar.h"

#include <glm/common.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace isoglass {

namespace {

/// Shares of the samples at or above the opaque and the semi-transparent surface.
constexpr std::array kShares{0.2, 0.7};
constexpr double kBackgroundShare = 0.25;
/// As many samples say as much as all.
constexpr int kMostSamplesPerAxis = 96;
constexpr double kSecondsPerKeyFrame = 0.5;
constexpr double kShortestSeconds = 4, kLongestSeconds = 60;

/// The longest run of equal values in sorted samples.
std::pair<float, std::size_t> mostFrequent(const std::vector<float>& sorted) {
    std::pair<float, std::size_t> best{0, 0};
    for (auto run = sorted.begin(); run != sorted.end();) {
        const auto end = std::upper_bound(run, sorted.end(), *run);
        const auto length = static_cast<std::size_t>(end - run);
        if (length > best.second) best = {*run, length};
        run = end;
    }
    return best;
}

std::vector<float> someSamples(const KeyFrame& frame) {
    const glm::ivec3 dims = frame.dims();
    const glm::ivec3 step = (dims + kMostSamplesPerAxis - 1) / kMostSamplesPerAxis;
    std::vector<float> samples;
    for (int z = 0; z < dims.z; z += step.z) {
        for (int y = 0; y < dims.y; y += step.y) {
            for (int x = 0; x < dims.x; x += step.x) {
                const float value = frame.sample({x, y, z});
                if (!std::isnan(value)) samples.push_back(value);
            }
        }
    }
    return samples;
}

/// The key frame in the middle; where all its samples are the same, the one whose samples differ most.
std::size_t chooseKeyFrame(const SeriesDescription& series) {
    const auto span = [](const FrameRecord& frame) { return frame.range.max - frame.range.min; };
    const std::size_t middle = series.frames.size() / 2;
    if (span(series.frames[middle]) > 0) return middle;
    const auto widest = std::ranges::max_element(series.frames, {}, span);
    return static_cast<std::size_t>(widest - series.frames.begin());
}

std::vector<Surface> chooseSurfaces(const SeriesFile& file, std::vector<std::string>& reasons) {
    const SeriesDescription& series = file.description();
    const std::size_t chosen = chooseKeyFrame(series);
    const IsoSuggestion suggestion = suggestIsoValues(someSamples(*file.read(chosen)));
    if (suggestion.values.empty()) {
        throw Error("there is no surface to show: all samples are the same or missing", file.path().string(),
                    "write a scene that names iso-values");
    }
    const std::array colors{LinearColor(0.74f, 0.054f, 0.03f), LinearColor(0.03f, 0.19f, 0.78f)};
    const std::array opacities{1.0f, 0.35f};
    std::vector<Surface> surfaces;
    for (const SuggestedIso& value : suggestion.values) {
        const std::size_t i = surfaces.size();
        Surface& surface = surfaces.emplace_back();
        surface.iso = value.iso;
        surface.color = colors[i];
        surface.opacity = opacities[i];
        std::string reason = "iso-value " + formatNumber(value.iso) + (series.units.empty() ? "" : " ") +
                             series.units + (i == 0 ? " (red, opaque): " : " (blue, semi-transparent): ") +
                             formatNumber(std::round(100 * value.share)) + " % of the samples reach it";
        if (suggestion.background)
            reason += ", not counting those of " + formatNumber(*suggestion.background);
        reasons.push_back(reason + " (key frame " + std::to_string(chosen) + ")");
    }
    return surfaces;
}

Timeline chooseTimeline(const TimeAxis& time) {
    Timeline timeline;
    const double unit = secondsPerUnit(time);
    const double end = time.period ? time.times.front() + *time.period : time.times.back();
    timeline.from = time.times.front() * unit;
    timeline.to = end * unit;
    const std::size_t steps = time.times.size() - (time.period ? 0 : 1);
    if (steps > 0) {
        timeline.duration =
            std::clamp(static_cast<double>(steps) * kSecondsPerKeyFrame, kShortestSeconds, kLongestSeconds);
    }
    return timeline;
}

/// Degrees beside metres have no common scale.
Placement choosePlace(const Lattice& lattice, const Bounds& box, std::vector<std::string>& reasons) {
    Placement place;
    const glm::dvec3 extent = box.high - box.low;
    const double widest = std::max(extent.x, extent.y);
    const std::string& units = lattice.heights ? lattice.heights->units : lattice.axes[2].units;
    const std::string& unitsOfX = lattice.axes[0].units;
    if (units == unitsOfX || !(extent.z > 0) || !(widest > 0)) return place;
    place.scale.z = widest / 3 / extent.z;
    const auto called = [](const std::string& name) { return name.empty() ? "not given" : name; };
    reasons.push_back("height is scaled by " + formatNumber(place.scale.z) + ": its units are " +
                      called(units) + ", those of x " + called(unitsOfX));
    return place;
}

CameraPose poseFor(const Bounds& box, const Scene& scene) {
    const Lens lens{.up = scene.camera.up, .fovDegrees = scene.camera.fovDegrees};
    const glm::dvec2 size(scene.image.size);
    return fitted(box, lens, {0.5, 1, -0.7}, size.x / size.y);
}

}  // namespace

IsoSuggestion suggestIsoValues(std::vector<float> samples) {
    std::ranges::sort(samples);
    if (samples.empty() || samples.front() == samples.back()) return {};
    IsoSuggestion suggestion;
    const double lowest = samples.front();
    const double middle = 0.5 * (lowest + samples.back());
    const auto [value, count] = mostFrequent(samples);
    if (static_cast<double>(count) >= kBackgroundShare * static_cast<double>(samples.size())) {
        suggestion.background = value;
        const auto run = std::ranges::equal_range(samples, value);
        samples.erase(run.begin(), run.end());
    }
    const auto suggest = [&](double iso) {
        const auto reaching = samples.end() - std::ranges::lower_bound(samples, static_cast<float>(iso));
        suggestion.values.push_back(
            {iso, static_cast<double>(reaching) / static_cast<double>(samples.size())});
    };
    if (samples.front() != samples.back()) {
        for (const double share : kShares) {
            const double iso = samples[static_cast<std::size_t>((1 - share) * (samples.size() - 1.0))];
            const double above = suggestion.values.empty() ? iso + 1 : suggestion.values.back().iso;
            // Everything is inside at the lowest value: there is no surface.
            if (iso > lowest && iso < above) suggest(iso);
        }
    }
    if (suggestion.values.empty()) suggest(middle);
    return suggestion;
}

FirstScene makeFirstScene(const SeriesFile& series, glm::ivec2 size) {
    const SeriesDescription& description = series.description();
    FirstScene first;
    const auto [low, high] = description.lattice.bounds();
    Volume volume;
    volume.name = description.name;
    volume.series = series.path();
    volume.place = choosePlace(description.lattice, {low, high}, first.reasons);
    volume.surfaces = chooseSurfaces(series, first.reasons);
    Scene& scene = first.scene;
    scene.image.size = size;
    scene.time = chooseTimeline(description.time);
    scene.camera.pose = poseFor(transformed(worldFromSeries(volume.place), {low, high}), scene);
    scene.volumes = {std::move(volume)};
    return first;
}

FirstScene makeMeshScene(const std::filesystem::path& file, glm::ivec2 size) {
    const MeshObject object{.name = file.stem().string(), .file = file};
    const auto mesh = readObject(object).mesh;
    if (mesh->empty()) throw Error("there is no surface to show: the mesh is empty", file.string());
    glm::vec3 low = mesh->positions.front(), high = low;
    for (const glm::vec3& position : mesh->positions) {
        low = glm::min(low, position);
        high = glm::max(high, position);
    }
    FirstScene first;
    first.scene.meshes = {object};
    first.scene.image.size = size;
    first.scene.camera.pose =
        poseFor({mesh->origin + glm::dvec3(low), mesh->origin + glm::dvec3(high)}, first.scene);
    return first;
}

}  // namespace isoglass
