#include "render/volume_store.h"

#include "base/error.h"

#include <glm/vector_relational.hpp>

#include <stdexcept>
#include <string>

namespace isoglass {
namespace {

[[noreturn]] void throwUnknown(VolumeId id) {
    throw std::invalid_argument("volume " + std::to_string(static_cast<std::uint64_t>(id)) +
                                " is not in the store");
}

void checkSize(glm::ivec3 dims) {
    GLint most = 0;
    glGetIntegerv(GL_MAX_3D_TEXTURE_SIZE, &most);
    if (glm::all(glm::lessThanEqual(dims, glm::ivec3(most)))) return;
    throw Error("the driver has textures of at most " + std::to_string(most) + " samples along an axis",
                "upload of a volume", "use a coarser level");
}

}  // namespace

VolumeId VolumeStore::upload(const VolumeSamples& samples) {
    checkSize(samples.dims);
    GpuVolume gpu{gl::Texture3D(GL_R32F, samples.dims, GL_LINEAR),
                  gl::Texture3D(GL_RG32F, samples.bricks, GL_NEAREST), samples.dims};
    gpu.values.write(GL_RED, samples.values);
    gpu.ranges.write(GL_RG, {&samples.ranges[0].x, 2 * samples.ranges.size()});
    context_.debugLog().throwIfAny("upload of a volume");
    const VolumeId id{++lastId_};
    volumes_.emplace(id, std::move(gpu));
    return id;
}

void VolumeStore::release(VolumeId id) {
    if (volumes_.erase(id) == 0) throwUnknown(id);
}

const GpuVolume& VolumeStore::get(VolumeId id) const {
    const auto found = volumes_.find(id);
    if (found == volumes_.end()) throwUnknown(id);
    return found->second;
}

}  // namespace isoglass
