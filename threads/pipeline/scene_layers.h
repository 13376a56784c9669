#pragma once

#include "pipeline/key_frame_cache.h"
#include "render/layer_draw.h"
#include "render/volume_samples.h"
#include "scene/scene.h"
#include "volume/lattice.h"

#include <array>
#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <vector>

namespace isoglass {

/// What the style "layers" shows at one moment: samples, not meshes.
struct SceneLayers {
    std::size_t volume = 0;  ///< index into `Scene::volumes`; the first of its surfaces is shown
    std::shared_ptr<const VolumeSamples> first;
    std::shared_ptr<const VolumeSamples> second;  ///< null where the moment is a key frame
    double fraction = 0;                          ///< of the time between them
    std::array<std::vector<double>, 3> axes;      ///< series coordinates of the samples
    std::vector<glm::dvec4> planes;               ///< that cut the volume, in series coordinates
};

/// Makes dense samples of key frames, and keeps those of the last two: between key frames they stay.
class LayerSamples {
  public:
    /// The finest level whose samples fit `kMostSampleBytes`.
    static int levelFor(const Lattice& lattice);
    static constexpr std::size_t kMostSampleBytes = std::size_t{256} << 20;

    std::shared_ptr<const VolumeSamples> of(FrameKey key, const KeyFrame& frame, int threads);

  private:
    std::array<std::pair<FrameKey, std::shared_ptr<const VolumeSamples>>, 2> last_;
    std::size_t next_ = 0;
};

/// Series coordinates of all samples that rays meet: a periodic axis has its closing one, too.
std::array<std::vector<double>, 3> sampleAxes(const Lattice& lattice);

/// Index of the volume that the scene shows in layers; nothing where it shows none.
std::optional<std::size_t> layeredVolume(const Scene& scene);

/// The render thread's side: uploads the samples of each key frame once and releases those that are no longer
/// shown.
class LayerUploads {
  public:
    /// Takes the samples of new meshes' moment. All members: the thread of `volumes`.
    void replace(const std::optional<SceneLayers>& layers, VolumeStore& volumes);

    /// How `scene` shows them, with the fraction of the time between key frames that the meshes' own grows by
    /// `motion`; nothing where there are none.
    std::optional<LayerDraw> draw(const Scene& scene, double motion) const;

  private:
    std::optional<SceneLayers> shown_;
    std::map<std::shared_ptr<const VolumeSamples>, VolumeId> uploaded_;
};

}  // namespace isoglass
