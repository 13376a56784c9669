#pragma once

#include "pipeline/key_frame_cache.h"
#include "render/frame_description.h"
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

/// What the styles "layers" and "volume" show at one moment: samples, not meshes.
struct SceneSamples {
    std::size_t volume = 0;  ///< index into `Scene::volumes`
    std::shared_ptr<const VolumeSamples> first;
    std::shared_ptr<const VolumeSamples> second;  ///< null where the moment is a key frame
    double fraction = 0;                          ///< of the time between them
    std::array<std::vector<double>, 3> axes;      ///< series coordinates of the samples
    std::vector<glm::dvec4> planes;               ///< that cut the volume, in series coordinates
};

/// Makes dense samples of key frames, and keeps two of them: of the key frame asked for, and of that nearest
/// to it of those kept before. Between key frames both stay, in whichever direction time goes.
class DenseSamples {
  public:
    /// The finest level whose samples fit `kMostSampleBytes`.
    static int levelFor(const Lattice& lattice);
    static constexpr std::size_t kMostSampleBytes = std::size_t{256} << 20;

    std::shared_ptr<const VolumeSamples> of(FrameKey key, const KeyFrame& frame, int threads);

  private:
    std::array<std::pair<FrameKey, std::shared_ptr<const VolumeSamples>>, 2> last_;
};

/// Series coordinates of all samples that rays meet: a periodic axis has its closing one, too.
std::array<std::vector<double>, 3> sampleAxes(const Lattice& lattice);

/// Index of the volume that the scene shows in layers or as a medium; nothing where it shows none.
std::optional<std::size_t> sampledVolume(const Scene& scene);

/// The render thread's side: uploads the samples of each key frame once and releases those that are no longer
/// shown.
class SampleUploads {
  public:
    /// Takes the samples of new meshes' moment. All members: the thread of `volumes`. Where it throws Error
    /// (VolumeStore::upload), the samples before stay shown.
    void replace(const std::optional<SceneSamples>& samples, VolumeStore& volumes);

    /// Adds to the frame what `scene` shows of them, with the fraction of the time between key frames that
    /// the meshes' own grows by `motion`; nothing where there are none.
    void describe(const Scene& scene, double motion, FrameDescription& frame) const;

  private:
    VolumeDraw volumeDraw(const Scene& scene, const Volume& volume, double motion) const;

    std::optional<SceneSamples> shown_;
    std::map<std::shared_ptr<const VolumeSamples>, VolumeId> uploaded_;
};

}  // namespace isoglass
