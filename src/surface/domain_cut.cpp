#include "surface/domain_cut.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace isoglass {

namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

bool usable(glm::vec3 v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z) && v != glm::vec3(0);
}

}  // namespace

void DomainCut::begin(glm::ivec3 end, BrickVertices& vertices, MeshPart& out) {
    end_ = end;
    vertices_ = &vertices;
    out_ = &out;
    firstTriangle_ = out.triangles.size();
    firstShared_ = out.shared.size();
    cuts_.clear();
}

VertexPolygon DomainCut::cut(const VertexPolygon& polygon, int axis) {
    const auto isInside = [&](std::uint32_t vertex) {
        return vertices_->place(vertex).index[axis] <= end_[axis];
    };
    VertexPolygon kept;
    for (int i = 0; i < polygon.size; ++i) {
        const std::uint32_t a = polygon.vertices[i];
        const std::uint32_t b = polygon.vertices[(i + 1) % polygon.size];
        if (isInside(a)) kept.add(a);
        if (isInside(a) != isInside(b)) kept.add(cutSide(a, b, axis));
    }
    return kept;
}

std::uint32_t DomainCut::cutSide(std::uint32_t a, std::uint32_t b, int axis) {
    if (vertices_->place(b).key < vertices_->place(a).key) std::swap(a, b);
    const BrickVertices::Place from = vertices_->place(a);
    const BrickVertices::Place to = vertices_->place(b);
    const VertexKey key = cutKey(from.key, to.key, axis);
    const auto [found, isNew] = cuts_.try_emplace(key, kNone);
    if (!isNew) return found->second;
    const double t = (end_[axis] - from.index[axis]) / (to.index[axis] - from.index[axis]);
    glm::dvec3 index = from.index + t * (to.index - from.index);
    index[axis] = end_[axis];
    const auto mix = [t](glm::vec3 low, glm::vec3 high) {
        return glm::vec3(glm::dvec3(low) + t * (glm::dvec3(high) - glm::dvec3(low)));
    };
    const glm::vec3 normal = mix(out_->normals[a], out_->normals[b]);
    found->second = vertices_->add(mix(out_->positions[a], out_->positions[b]),
                                   usable(normal) ? normal : out_->normals[a], {index, key}, true);
    return found->second;
}

void DomainCut::dropUnused() {
    const std::uint32_t first = vertices_->first();
    std::vector<std::uint32_t> place(out_->positions.size() - first, kNone);
    for (std::size_t i = firstTriangle_; i < out_->triangles.size(); ++i)
        place[out_->triangles[i] - first] = 0;
    std::uint32_t next = first;
    for (std::size_t i = 0; i < place.size(); ++i) {
        if (place[i] == kNone) continue;
        out_->positions[next] = out_->positions[first + i];
        out_->normals[next] = out_->normals[first + i];
        place[i] = next++;
    }
    out_->positions.resize(next);
    out_->normals.resize(next);
    for (std::size_t i = firstTriangle_; i < out_->triangles.size(); ++i)
        out_->triangles[i] = place[out_->triangles[i] - first];
    const auto begin = out_->shared.begin() + static_cast<std::ptrdiff_t>(firstShared_);
    const auto isUnused = [&](const MeshPart::Shared& entry) { return place[entry.vertex - first] == kNone; };
    out_->shared.erase(std::remove_if(begin, out_->shared.end(), isUnused), out_->shared.end());
    for (std::size_t i = firstShared_; i < out_->shared.size(); ++i)
        out_->shared[i].vertex = place[out_->shared[i].vertex - first];
}

}  // namespace isoglass
