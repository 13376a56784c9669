#pragma once

#include "gl/context.h"
#include "gl/objects.h"
#include "render/volume_samples.h"

#include <cstdint>
#include <map>

namespace isoglass {

/// Names uploaded samples; never used again after their release.
enum class VolumeId : std::uint64_t {};

/// Samples in the memory of the GPU; immutable.
struct GpuVolume {
    gl::Texture3D values;  ///< one float, linear
    gl::Texture3D ranges;  ///< two floats, nearest
    glm::ivec3 dims;
};

/// The volumes of the render thread, as MeshStore has its meshes. All members belong to that thread.
class VolumeStore {
  public:
    /// `context` must outlive the store and be current.
    explicit VolumeStore(gl::Context& context) : context_(context) {}

    /// Copies the samples. Throws Error where they do not fit the GPU; the store is then as it was.
    VolumeId upload(const VolumeSamples& samples);
    /// Frees them. An id that is not in the store is a mistake of the caller: std::invalid_argument.
    void release(VolumeId id);

    /// Throws std::invalid_argument for an id that is not in the store.
    const GpuVolume& get(VolumeId id) const;
    std::size_t count() const { return volumes_.size(); }

  private:
    gl::Context& context_;
    std::map<VolumeId, GpuVolume> volumes_;
    std::uint64_t lastId_ = 0;
};

}  // namespace isoglass
