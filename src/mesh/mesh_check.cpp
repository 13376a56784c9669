#include "mesh/mesh_check.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

namespace isoglass {

namespace {

using Index = std::uint32_t;

/// Sets of joined things (Tarjan 1975), with path halving.
class DisjointSets {
  public:
    explicit DisjointSets(std::size_t count) : parent_(count) {
        std::iota(parent_.begin(), parent_.end(), Index{0});
    }
    Index root(Index item) {
        while (parent_[item] != item) item = parent_[item] = parent_[parent_[item]];
        return item;
    }
    void join(Index a, Index b) { parent_[root(a)] = root(b); }

  private:
    std::vector<Index> parent_;
};

std::uint64_t pack(Index high, Index low) {
    return static_cast<std::uint64_t>(high) << 32 | low;
}

bool isDegenerate(const Index* corner) {
    return corner[0] == corner[1] || corner[1] == corner[2] || corner[2] == corner[0];
}

/// An edge as one of its triangles walks it.
struct DirectedEdge {
    std::uint64_t vertices;  ///< the smaller index first
    bool backwards;          ///< from the larger index to the smaller
};

std::vector<DirectedEdge> sortedEdges(std::span<const Index> triangles) {
    std::vector<DirectedEdge> edges;
    edges.reserve(triangles.size());
    for (std::size_t t = 0; t < triangles.size(); t += 3) {
        if (isDegenerate(&triangles[t])) continue;
        for (std::size_t i = 0; i < 3; ++i) {
            const Index from = triangles[t + i];
            const Index to = triangles[t + (i + 1) % 3];
            edges.push_back({pack(std::min(from, to), std::max(from, to)), from > to});
        }
    }
    std::ranges::sort(edges, {}, &DirectedEdge::vertices);
    return edges;
}

/// Counts edges by how many triangles share them; returns how many edges there are.
std::size_t countEdges(std::span<const DirectedEdge> edges, MeshTopology& topology) {
    std::size_t count = 0;
    for (std::size_t begin = 0, end = 0; begin < edges.size(); begin = end, ++count) {
        while (end < edges.size() && edges[end].vertices == edges[begin].vertices) ++end;
        const std::size_t triangles = end - begin;
        topology.boundaryEdges += triangles == 1;
        topology.nonManifoldEdges += triangles > 2;
        topology.misorientedEdges += triangles == 2 && edges[begin].backwards == edges[begin + 1].backwards;
    }
    return count;
}

/// The other two vertices of each triangle, grouped by vertex.
struct Links {
    std::vector<std::size_t> begin;    ///< one a vertex, and the end
    std::vector<std::uint64_t> edges;  ///< two vertices each
};

Links linksOf(const SurfaceMesh& mesh) {
    const std::vector<Index>& triangles = mesh.triangles;
    Links links;
    links.begin.assign(mesh.vertexCount() + 1, 0);
    for (std::size_t t = 0; t < triangles.size(); t += 3) {
        if (isDegenerate(&triangles[t])) continue;
        for (std::size_t i = 0; i < 3; ++i) ++links.begin[triangles[t + i] + 1];
    }
    std::partial_sum(links.begin.begin(), links.begin.end(), links.begin.begin());
    links.edges.resize(links.begin.back());
    std::vector<std::size_t> next(links.begin.begin(), links.begin.end() - 1);
    for (std::size_t t = 0; t < triangles.size(); t += 3) {
        if (isDegenerate(&triangles[t])) continue;
        for (std::size_t i = 0; i < 3; ++i) {
            links.edges[next[triangles[t + i]]++] =
                pack(triangles[t + (i + 1) % 3], triangles[t + (i + 2) % 3]);
        }
    }
    return links;
}

/// True where the edges form one path or one cycle: connected, no vertex in more than two, which is what
/// the link of a point of a surface looks like.
bool isPathOrCycle(std::span<const std::uint64_t> edges, std::vector<Index>& ends) {
    ends.clear();
    for (const std::uint64_t edge : edges) {
        ends.push_back(static_cast<Index>(edge >> 32));
        ends.push_back(static_cast<Index>(edge));
    }
    std::ranges::sort(ends);
    for (std::size_t i = 2; i < ends.size(); ++i) {
        if (ends[i] == ends[i - 2]) return false;
    }
    ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
    const auto place = [&](std::uint64_t vertex) {
        return static_cast<Index>(std::ranges::lower_bound(ends, static_cast<Index>(vertex)) - ends.begin());
    };
    DisjointSets pieces(ends.size());
    std::size_t count = ends.size();
    for (const std::uint64_t edge : edges) {
        const Index a = pieces.root(place(edge >> 32));
        const Index b = pieces.root(place(edge));
        if (a == b) continue;
        pieces.join(a, b);
        --count;
    }
    return count == 1;
}

std::size_t countComponents(const SurfaceMesh& mesh, const Links& links) {
    DisjointSets pieces(mesh.vertexCount());
    for (std::size_t t = 0; t < mesh.triangles.size(); t += 3) {
        if (isDegenerate(&mesh.triangles[t])) continue;
        pieces.join(mesh.triangles[t], mesh.triangles[t + 1]);
        pieces.join(mesh.triangles[t], mesh.triangles[t + 2]);
    }
    std::size_t count = 0;
    for (std::size_t v = 0; v < mesh.vertexCount(); ++v) {
        count += links.begin[v] != links.begin[v + 1] && pieces.root(static_cast<Index>(v)) == v;
    }
    return count;
}

bool isFinite(glm::vec3 v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

}  // namespace

MeshTopology checkTopology(const SurfaceMesh& mesh) {
    MeshTopology topology;
    const std::vector<DirectedEdge> edges = sortedEdges(mesh.triangles);
    const std::size_t triangles = edges.size() / 3;
    topology.degenerateTriangles = mesh.triangleCount() - triangles;
    const std::size_t edgeCount = countEdges(edges, topology);

    const Links links = linksOf(mesh);
    std::vector<Index> scratch;
    for (std::size_t v = 0; v < mesh.vertexCount(); ++v) {
        const std::span<const std::uint64_t> link(links.edges.data() + links.begin[v],
                                                  links.begin[v + 1] - links.begin[v]);
        if (link.empty()) {
            ++topology.unreferencedVertices;
        } else if (!isPathOrCycle(link, scratch)) {
            ++topology.nonManifoldVertices;
        }
    }
    topology.components = countComponents(mesh, links);
    const std::size_t vertices = mesh.vertexCount() - topology.unreferencedVertices;
    topology.eulerNumber =
        static_cast<std::ptrdiff_t>(vertices + triangles) - static_cast<std::ptrdiff_t>(edgeCount);
    return topology;
}

MeshMeasures measure(const SurfaceMesh& mesh) {
    MeshMeasures measures;
    bool first = true;
    for (const glm::vec3& position : mesh.positions) {
        if (!isFinite(position)) {
            ++measures.nonFiniteVertices;
            continue;
        }
        const glm::dvec3 point(position);
        measures.bounds[0] = first ? point : glm::min(measures.bounds[0], point);
        measures.bounds[1] = first ? point : glm::max(measures.bounds[1], point);
        first = false;
    }
    // Tetrahedra from the first corner of the bounds stay small however far away the origin lies.
    const glm::dvec3 apex = measures.bounds[0];
    for (std::size_t t = 0; t < mesh.triangles.size(); t += 3) {
        std::array<glm::dvec3, 3> corner;
        bool finite = true;
        for (std::size_t i = 0; i < 3; ++i) {
            const glm::vec3& position = mesh.positions[mesh.triangles[t + i]];
            finite = finite && isFinite(position);
            corner[i] = glm::dvec3(position) - apex;
        }
        if (!finite) continue;
        const glm::dvec3 normal = glm::cross(corner[1] - corner[0], corner[2] - corner[0]);
        measures.area += glm::length(normal) / 2;
        measures.volume += glm::dot(corner[0], normal) / 6;
        measures.zeroAreaTriangles += normal == glm::dvec3(0);
    }
    return measures;
}

}  // namespace isoglass
