#include "pipeline/scene_layers.h"

#include "basis/parallel.h"

#include <algorithm>

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

}  // namespace

int LayerSamples::levelFor(const Lattice& lattice) {
    int level = 0;
    for (glm::ivec3 cells = lattice.cells();; cells = (cells + 1) / 2, ++level) {
        const glm::dvec3 dims(cells + 1);
        if (dims.x * dims.y * dims.z * sizeof(float) <= static_cast<double>(kMostSampleBytes)) return level;
    }
}

std::shared_ptr<const VolumeSamples> LayerSamples::of(FrameKey key, const KeyFrame& frame, int threads) {
    for (const auto& [known, samples] : last_) {
        if (samples && known == key) return samples;
    }
    auto& place = last_[next_];
    next_ = 1 - next_;
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

std::optional<std::size_t> layeredVolume(const Scene& scene) {
    if (!scene.layers) return std::nullopt;
    if (scene.layers->volume.empty()) return 0;
    const auto found = std::ranges::find(scene.volumes, scene.layers->volume, &Volume::name);
    return static_cast<std::size_t>(found - scene.volumes.begin());
}

void LayerUploads::replace(const std::optional<SceneLayers>& layers, VolumeStore& volumes) {
    std::map<std::shared_ptr<const VolumeSamples>, VolumeId> needed;
    if (layers) {
        for (const auto& samples : {layers->first, layers->second}) {
            if (!samples || needed.contains(samples)) continue;
            const auto known = uploaded_.find(samples);
            needed[samples] = known != uploaded_.end() ? known->second : volumes.upload(*samples);
        }
    }
    for (const auto& [samples, id] : uploaded_) {
        if (!needed.contains(samples)) volumes.release(id);
    }
    uploaded_ = std::move(needed);
    shown_ = layers;
}

std::optional<LayerDraw> LayerUploads::draw(const Scene& scene, double motion) const {
    if (!shown_) return std::nullopt;
    const Volume& volume = scene.volumes[shown_->volume];
    const Surface& surface = volume.surfaces.front();
    LayerDraw draw;
    draw.first = uploaded_.at(shown_->first);
    draw.second = draw.first;
    if (shown_->second) {
        draw.second = uploaded_.at(shown_->second);
        draw.fraction = static_cast<float>(shown_->fraction + motion);
    }
    draw.iso = static_cast<float>(surface.iso);
    draw.worldFromSeries = worldFromSeries(volume.place);
    draw.axes = shown_->axes;
    draw.planes = shown_->planes;
    draw.style = *scene.layers;
    draw.color = surface.color;
    return draw;
}

}  // namespace isoglass
