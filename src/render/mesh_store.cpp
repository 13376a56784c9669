#include "render/mesh_store.h"

#include "base/error.h"

#include <glm/common.hpp>

#include <limits>
#include <span>
#include <stdexcept>
#include <string>

namespace isoglass {
namespace {

Bounds boundsOf(const std::vector<glm::vec3>& positions) {
    if (positions.empty()) return {glm::dvec3(0), glm::dvec3(0)};
    glm::vec3 low = positions.front();
    glm::vec3 high = low;
    for (const glm::vec3& position : positions) {
        low = glm::min(low, position);
        high = glm::max(high, position);
    }
    return {low, high};
}

bool isFlat(const Bounds& bounds) {
    return bounds.low.x == bounds.high.x || bounds.low.y == bounds.high.y || bounds.low.z == bounds.high.z;
}

template <typename T>
gl::Buffer uploaded(const std::vector<T>& values) {
    return gl::Buffer::immutable(std::as_bytes(std::span(values)));
}

[[noreturn]] void throwUnknown(MeshId id) {
    throw std::invalid_argument("mesh " + std::to_string(static_cast<std::uint64_t>(id)) +
                                " is not in the store");
}

}  // namespace

MeshId MeshStore::upload(const SurfaceMesh& mesh) {
    if (mesh.triangles.size() > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max())) {
        throw Error(
            "a surface of " + std::to_string(mesh.triangleCount()) + " triangles is too large to draw",
            "upload of a mesh", "use a coarser level");
    }
    const Bounds bounds = boundsOf(mesh.positions);
    GpuMesh gpu{uploaded(mesh.positions),
                uploaded(mesh.normals),
                uploaded(mesh.triangles),
                mesh.colorValues.empty() ? std::nullopt : std::optional(uploaded(mesh.colorValues)),
                mesh.velocities.empty() ? std::nullopt : std::optional(uploaded(mesh.velocities)),
                gl::VertexArray(),
                static_cast<std::int32_t>(mesh.triangles.size()),
                mesh.origin,
                bounds,
                isFlat(bounds)};
    gpu.vertexArray.setVec3(0, gpu.positions);
    gpu.vertexArray.setVec3(1, gpu.normals);
    if (gpu.colorValues) gpu.vertexArray.setFloat(2, *gpu.colorValues);
    if (gpu.velocities) gpu.vertexArray.setVec3(3, *gpu.velocities);
    gpu.vertexArray.setIndices(gpu.triangles);
    context_.debugLog().throwIfAny("upload of a mesh");
    const MeshId id{++lastId_};
    meshes_.emplace(id, std::move(gpu));
    return id;
}

void MeshStore::release(MeshId id) {
    if (meshes_.erase(id) == 0) throwUnknown(id);
}

const GpuMesh& MeshStore::get(MeshId id) const {
    const auto found = meshes_.find(id);
    if (found == meshes_.end()) throwUnknown(id);
    return found->second;
}

std::size_t MeshStore::bytes() const {
    std::size_t sum = 0;
    for (const auto& [id, mesh] : meshes_) {
        sum += mesh.positions.bytes() + mesh.normals.bytes() + mesh.triangles.bytes();
        if (mesh.colorValues) sum += mesh.colorValues->bytes();
        if (mesh.velocities) sum += mesh.velocities->bytes();
    }
    return sum;
}

}  // namespace isoglass
