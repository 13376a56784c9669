#include "pipeline/scene_samples.h"

#include "basis/parallel.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <string>
#include <tuple>

namespace isoglass {

namespace {

std::shared_ptr<const VolumeSamples> denseSamples(const KeyFrame& frame, int threads) {
    const glm::ivec3 dims = frame.cells() + 1;
    std::vector<float> values(static_cast<std::size_t>(dims.x) * dims.y * dims.z);
    parallelFor(static_cast<std::size_t>(dims.z), 1, threads, [&](std::size_t begin, std::size_t end) {
        for (auto z = static_cast<int>(begin); z < static_cast<int>(end); ++z) {
            std::size_t i = static_cast<std::size_t>(z) * dims.y * dims.x;
            for (int y = 0; y < dims.y; ++y) {
                // The closing sample of a periodic axis is the first one.
                for (int x = 0; x < dims.x; ++x)
                    values[i++] = frame.sample(glm::ivec3(x, y, z) % frame.dims());
            }
        }
    });
    return std::make_shared<const VolumeSamples>(makeVolumeSamples(dims, std::move(values)));
}

/// A hundredth of the longest of the volume's four diagonals in the world, so that opacities mean much the
/// same for volumes of any size, however they are turned.
double usualUnit(const VolumeDraw& draw) {
    glm::dvec3 size;
    for (int k = 0; k < 3; ++k) {
        const auto& axis = draw.axes[static_cast<std::size_t>(k)];
        size[k] = axis.back() - axis.front();
    }
    double longest = 0;
    for (const glm::dvec3& signs : {glm::dvec3(1, 1, 1), {-1, 1, 1}, {1, -1, 1}, {1, 1, -1}})
        longest = std::max(longest, glm::length(glm::dmat3(draw.worldFromSeries) * (signs * size)));
    return longest / 100;
}

/// How far a key frame is from another: those of other series and levels are farthest.
std::tuple<bool, std::size_t> distance(const FrameKey& a, const FrameKey& b) {
    return {a.series != b.series || a.level != b.level,
            std::max(a.frame, b.frame) - std::min(a.frame, b.frame)};
}

}  // namespace

int DenseSamples::levelFor(const Lattice& lattice) {
    int level = 0;
    for (glm::ivec3 cells = lattice.cells();; cells = (cells + 1) / 2, ++level) {
        const glm::dvec3 dims(cells + 1);
        if (dims.x * dims.y * dims.z * sizeof(float) <= static_cast<double>(kMostSampleBytes)) return level;
    }
}

std::shared_ptr<const VolumeSamples> DenseSamples::of(FrameKey key, const KeyFrame& frame, int threads) {
    for (const auto& [known, samples] : last_) {
        if (samples && known == key) return samples;
    }
    // Of both ends of an interval the one stays that the next interval shares, whichever way time goes.
    const auto dispensable = [&](const auto& place) {
        return std::pair(!place.second, distance(place.first, key));
    };
    auto& place = dispensable(last_[0]) > dispensable(last_[1]) ? last_[0] : last_[1];
    place = {key, denseSamples(frame, threads)};
    return place.second;
}

std::array<std::vector<double>, 3> sampleAxes(const Lattice& lattice) {
    std::array<std::vector<double>, 3> axes;
    for (std::size_t k = 0; k < 3; ++k) {
        for (std::size_t i = 0; i <= lattice.axes[k].cells(); ++i)
            axes[k].push_back(lattice.axes[k].coordinate(i));
    }
    return axes;
}

std::optional<std::size_t> sampledVolume(const Scene& scene) {
    if (!scene.layers && !scene.shaded) return std::nullopt;
    const std::string& name = scene.layers ? scene.layers->volume : scene.shaded->volume;
    if (name.empty()) return 0;
    const auto found = std::ranges::find(scene.volumes, name, &Volume::name);
    return static_cast<std::size_t>(found - scene.volumes.begin());
}

void SampleUploads::replace(const std::optional<SceneSamples>& samples, VolumeStore& volumes) {
    if (samples) {
        for (const auto& each : {samples->first, samples->second}) {
            if (each && !uploaded_.contains(each)) uploaded_.emplace(each, volumes.upload(*each));
        }
    }
    std::erase_if(uploaded_, [&](const auto& entry) {
        const auto& [each, id] = entry;
        if (samples && (each == samples->first || each == samples->second)) return false;
        volumes.release(id);
        return true;
    });
    shown_ = samples;
}

VolumeDraw SampleUploads::volumeDraw(const Scene& scene, const Volume& volume, double motion) const {
    VolumeDraw draw;
    draw.first = uploaded_.at(shown_->first);
    draw.second = draw.first;
    if (shown_->second) {
        draw.second = uploaded_.at(shown_->second);
        draw.fraction = static_cast<float>(shown_->fraction + motion);
    }
    draw.worldFromSeries = worldFromSeries(volume.place);
    draw.axes = shown_->axes;
    draw.planes = shown_->planes;
    for (const ClipSolid& solid : volume.solids)
        draw.solids.push_back({solid.shape, solid.keep, worldFromSeries(solid.place)});
    const glm::dmat4 seriesFromWorld = glm::inverse(draw.worldFromSeries);
    for (const ClipSolid& solid : scene.solids)
        draw.solids.push_back({solid.shape, solid.keep, seriesFromWorld * worldFromSeries(solid.place)});
    return draw;
}

void SampleUploads::describe(const Scene& scene, double motion, FrameDescription& frame) const {
    if (!shown_) return;
    const Volume& volume = scene.volumes[shown_->volume];
    if (scene.layers) {
        LayerDraw& draw = frame.layerDraw.emplace();
        static_cast<VolumeDraw&>(draw) = volumeDraw(scene, volume, motion);
        const Surface& surface = volume.surfaces.front();
        draw.iso = static_cast<float>(surface.iso);
        draw.style = *scene.layers;
        draw.color = surface.color;
    } else {
        ShadedDraw& draw = frame.shadedDraw.emplace();
        static_cast<VolumeDraw&>(draw) = volumeDraw(scene, volume, motion);
        draw.style = *scene.shaded;
        if (!draw.style.unit) draw.style.unit = usualUnit(draw);
    }
}

}  // namespace isoglass
