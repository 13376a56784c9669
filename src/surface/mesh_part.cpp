#include "surface/mesh_part.h"

#include "basis/parallel.h"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <stdexcept>
#include <utility>

namespace isoglass {

namespace {

constexpr std::size_t kShardBits = 6;
constexpr std::size_t kShards = std::size_t{1} << kShardBits;

/// Finaliser of splitmix64 (Steele, Lea, Flood 2014).
constexpr std::uint64_t mix(std::uint64_t x) {
    x = (x ^ x >> 30) * 0xbf58476d1ce4e5b9u;
    x = (x ^ x >> 27) * 0x94d049bb133111ebu;
    return x ^ x >> 31;
}

std::uint64_t hash(VertexKey key) {
    return mix(key.low + 0x9e3779b97f4a7c15u * (key.high + 1));
}

/// The shared vertices of a part, those of a shard together, in their order.
struct Sorted {
    std::vector<MeshPart::Shared> shared;
    std::array<std::uint32_t, kShards + 1> begin{};
};

Sorted sortByShard(const std::vector<MeshPart::Shared>& shared) {
    const auto shardOf = [](VertexKey key) { return hash(key) >> (64 - kShardBits); };
    Sorted sorted;
    for (const MeshPart::Shared& entry : shared) ++sorted.begin[shardOf(entry.key) + 1];
    for (std::size_t i = 0; i < kShards; ++i) sorted.begin[i + 1] += sorted.begin[i];
    auto next = sorted.begin;
    sorted.shared.resize(shared.size());
    for (const MeshPart::Shared& entry : shared) sorted.shared[next[shardOf(entry.key)]++] = entry;
    return sorted;
}

/// Joins the vertices of one shard: `same[i]` becomes the first vertex that has the key of vertex i.
void joinShard(std::size_t shard, const std::vector<Sorted>& parts,
               const std::vector<std::uint32_t>& firstVertex, std::vector<std::uint32_t>& same) {
    std::size_t entries = 0;
    for (const Sorted& part : parts) entries += part.begin[shard + 1] - part.begin[shard];
    constexpr std::uint32_t kFree = std::numeric_limits<std::uint32_t>::max();
    const std::size_t mask = std::bit_ceil(2 * entries + 1) - 1;
    std::vector<MeshPart::Shared> table(mask + 1, {{}, kFree});
    for (std::size_t p = 0; p < parts.size(); ++p) {
        for (std::size_t i = parts[p].begin[shard]; i < parts[p].begin[shard + 1]; ++i) {
            const MeshPart::Shared& entry = parts[p].shared[i];
            const std::uint32_t vertex = firstVertex[p] + entry.vertex;
            std::size_t place = hash(entry.key) & mask;
            while (table[place].vertex != kFree && table[place].key != entry.key) place = (place + 1) & mask;
            if (table[place].vertex == kFree) {
                table[place] = {entry.key, vertex};
            } else {
                same[vertex] = table[place].vertex;
            }
        }
    }
}

template <typename Count>
std::vector<std::uint32_t> offsets(std::size_t parts, Count count) {
    std::vector<std::uint32_t> result(parts + 1, 0);
    std::size_t sum = 0;
    for (std::size_t p = 0; p < parts; ++p) {
        sum += count(p);
        if (sum >= std::numeric_limits<std::uint32_t>::max())
            throw std::length_error("the surface has more than 2^32 vertices or triangles");
        result[p + 1] = static_cast<std::uint32_t>(sum);
    }
    return result;
}

}  // namespace

VertexKey cutKey(VertexKey a, VertexKey b, int axis) {
    if (b < a) std::swap(a, b);
    // A digest of 127 bits: among the cuts of one mesh no two meet but by design. The highest bit keeps
    // cuts apart from edges.
    VertexKey key{mix(axis + 1), mix(axis + 5)};
    for (const std::uint64_t word : {a.high, a.low, b.high, b.low}) {
        key.high = mix(key.high ^ word);
        key.low = mix(key.low * 0x9e3779b97f4a7c15u + word);
    }
    key.high |= std::uint64_t{1} << 63;
    return key;
}

SurfaceMesh joinParts(std::vector<MeshPart>& parts, glm::dvec3 origin, int threads) {
    const auto firstVertex = offsets(parts.size(), [&](std::size_t p) { return parts[p].positions.size(); });
    const auto firstTriangle =
        offsets(parts.size(), [&](std::size_t p) { return parts[p].triangles.size() / 3; });
    const auto forParts = [&](const auto& body) {
        parallelFor(parts.size(), 1, threads, [&](std::size_t begin, std::size_t end) {
            for (std::size_t p = begin; p < end; ++p) body(p);
        });
    };

    std::vector<Sorted> sorted(parts.size());
    std::vector<std::uint32_t> same(firstVertex.back());
    forParts([&](std::size_t p) {
        sorted[p] = sortByShard(parts[p].shared);
        for (std::uint32_t i = firstVertex[p]; i < firstVertex[p + 1]; ++i) same[i] = i;
    });
    parallelFor(kShards, 1, threads, [&](std::size_t begin, std::size_t end) {
        for (std::size_t shard = begin; shard < end; ++shard) joinShard(shard, sorted, firstVertex, same);
    });

    std::vector<std::uint32_t> kept(parts.size());
    forParts([&](std::size_t p) {
        std::uint32_t count = 0;
        for (std::uint32_t i = firstVertex[p]; i < firstVertex[p + 1]; ++i) count += same[i] == i;
        kept[p] = count;
    });
    const auto firstKept = offsets(parts.size(), [&](std::size_t p) { return kept[p]; });

    SurfaceMesh mesh;
    mesh.origin = origin;
    mesh.positions.resize(firstKept.back());
    mesh.normals.resize(firstKept.back());
    mesh.triangles.resize(3 * static_cast<std::size_t>(firstTriangle.back()));
    std::vector<std::uint32_t> place(firstVertex.back());
    forParts([&](std::size_t p) {
        std::uint32_t next = firstKept[p];
        for (std::uint32_t i = firstVertex[p]; i < firstVertex[p + 1]; ++i) {
            if (same[i] != i) continue;
            mesh.positions[next] = parts[p].positions[i - firstVertex[p]];
            mesh.normals[next] = parts[p].normals[i - firstVertex[p]];
            place[i] = next++;
        }
    });
    forParts([&](std::size_t p) {
        std::uint32_t* out = mesh.triangles.data() + 3 * static_cast<std::size_t>(firstTriangle[p]);
        for (const std::uint32_t vertex : parts[p].triangles) *out++ = place[same[firstVertex[p] + vertex]];
    });
    return mesh;
}

}  // namespace isoglass
