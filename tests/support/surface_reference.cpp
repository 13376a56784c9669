#include "support/surface_reference.h"

#include "surface/cell_table.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <vector>

namespace isoglass {

namespace {

glm::ivec3 cornerOffset(int corner) {
    return {corner & 1, corner >> 1 & 1, corner >> 2};
}

/// The samples as a function on the lattice, NaN outside it.
class DenseField {
  public:
    DenseField(const Lattice& lattice, std::span<const float> samples)
        : lattice_(lattice), samples_(samples), dims_(lattice.dims()) {}

    double value(glm::ivec3 i) const {
        for (int k = 0; k < 3; ++k) {
            if (lattice_.axes[k].period) i[k] = (i[k] + dims_[k]) % dims_[k];
            if (i[k] < 0 || i[k] >= dims_[k]) return std::numeric_limits<double>::quiet_NaN();
        }
        return samples_[(static_cast<std::size_t>(i.z) * dims_.y + i.y) * dims_.x + i.x];
    }

    /// World coordinate, continued by whole periods.
    double coordinate(int axis, int i) const {
        const Axis& a = lattice_.axes[axis];
        const int count = static_cast<int>(a.size());
        if (!a.period) return a.coordinates[i];
        const double turn = a.descending() ? -*a.period : *a.period;
        const int wraps = i < 0 ? -1 : i / count;
        return a.coordinates[i - wraps * count] + wraps * turn;
    }

    glm::dvec3 world(glm::ivec3 i) const {
        return {coordinate(0, i.x), coordinate(1, i.y), coordinate(2, i.z)};
    }

    /// Slope at i of the parabola through three samples; of the line through two where one is missing.
    double derivative(int axis, glm::ivec3 i) const {
        glm::ivec3 step(0);
        step[axis] = 1;
        const double before = value(i - step);
        const double here = value(i);
        const double after = value(i + step);
        if (std::isnan(before) && std::isnan(after)) return 0;
        const auto slope = [&](int from, double a, double b) {
            return (b - a) / (coordinate(axis, from + 1) - coordinate(axis, from));
        };
        if (std::isnan(before)) return slope(i[axis], here, after);
        if (std::isnan(after)) return slope(i[axis] - 1, before, here);
        const double left = coordinate(axis, i[axis]) - coordinate(axis, i[axis] - 1);
        const double right = coordinate(axis, i[axis] + 1) - coordinate(axis, i[axis]);
        return (slope(i[axis] - 1, before, here) * right + slope(i[axis], here, after) * left) /
               (left + right);
    }

    glm::dvec3 gradient(glm::ivec3 i) const { return {derivative(0, i), derivative(1, i), derivative(2, i)}; }

  private:
    const Lattice& lattice_;
    std::span<const float> samples_;
    glm::ivec3 dims_;
};

class Extractor {
  public:
    Extractor(const Lattice& lattice, std::span<const float> samples, float iso, bool insideIsBelow)
        : lattice_(lattice), field_(lattice, samples), iso_(iso), below_(insideIsBelow) {}

    ReferenceSurface run() {
        const glm::ivec3 cells = lattice_.cells();
        for (int z = 0; z < cells.z; ++z) {
            for (int y = 0; y < cells.y; ++y) {
                for (int x = 0; x < cells.x; ++x) addCell({x, y, z});
            }
        }
        for (const auto& [edge, vertex] : surface_.vertices) surface_.pinchedEdges += edge.second;
        return std::move(surface_);
    }

  private:
    bool inside(double value) const { return below_ ? value <= iso_ : value >= iso_; }

    bool isWhole(glm::ivec3 cell) const {
        const glm::ivec3 cells = lattice_.cells();
        for (int k = 0; k < 3; ++k) {
            if (cell[k] < 0 || cell[k] >= cells[k]) return false;
        }
        for (int corner = 0; corner < 8; ++corner) {
            if (std::isnan(field_.value(cell + cornerOffset(corner)))) return false;
        }
        return true;
    }

    void addCell(glm::ivec3 cell) {
        int pattern = 0;
        int valid = 0;
        for (int corner = 0; corner < 8; ++corner) {
            const double value = field_.value(cell + cornerOffset(corner));
            if (std::isnan(value)) continue;
            ++valid;
            pattern |= static_cast<int>(inside(value)) << corner;
        }
        if (valid < 8) {
            const int insideCount = __builtin_popcount(static_cast<unsigned>(pattern));
            surface_.lostCells += insideCount > 0 && insideCount < valid;
            return;
        }
        for (const auto& triangle : cellTable()[pattern].compact) addTriangle(cell, triangle);
    }

    void addTriangle(glm::ivec3 cell, const std::array<std::uint8_t, 3>& edges) {
        ReferenceSurface::Triangle triangle;
        for (int k = 0; k < 3; ++k) triangle[k] = vertexOn(cell, kCellEdge[edges[k]]);
        if (turnsLeftHanded()) std::swap(triangle[1], triangle[2]);
        std::rotate(triangle.begin(), std::min_element(triangle.begin(), triangle.end()), triangle.end());
        surface_.triangles.insert(triangle);
    }

    bool turnsLeftHanded() const {
        double sign = 1;
        for (int k = 0; k < 3; ++k) sign *= field_.coordinate(k, 1) - field_.coordinate(k, 0) > 0 ? 1 : -1;
        return sign < 0;
    }

    LatticeEdge vertexOn(glm::ivec3 cell, CellEdge cellEdge) {
        const glm::ivec3 low = cell + cornerOffset(cellEdge.corner);
        const glm::ivec3 high = low + cornerOffset(cellEdge.direction);
        LatticeEdge edge{low.x, low.y, low.z, cellEdge.direction};
        const int firstOther = edge.direction == 1 ? 1 : 0;
        edge.second = low[firstOther] > cell[firstOther] && isPinched(edge);
        const auto [place, isNew] = surface_.vertices.try_emplace(edge);
        if (!isNew) return edge;
        ReferenceSurface::Vertex& vertex = place->second;
        const double t = (iso_ - field_.value(low)) / (field_.value(high) - field_.value(low));
        vertex.position = glm::mix(field_.world(low), field_.world(high), t);
        const double sign = below_ ? 1 : -1;
        vertex.normal = sign * glm::mix(field_.gradient(low), field_.gradient(high), t);
        if (vertex.normal == glm::dvec3(0)) {
            const glm::dvec3 along = field_.world(high) - field_.world(low);
            const double slope = (field_.value(high) - field_.value(low)) / glm::dot(along, along);
            vertex.normal = sign * slope * along;
            vertex.byEdge = true;
        }
        return edge;
    }

    bool isPinched(const LatticeEdge& edge) const {
        if (edge.direction == 7) return false;
        const int axis = edge.direction == 1 ? 0 : edge.direction == 2 ? 1 : 2;
        glm::ivec3 u(0);
        glm::ivec3 v(0);
        u[(axis + 1) % 3] = 1;
        v[(axis + 2) % 3] = 1;
        const glm::ivec3 cell(edge.x, edge.y, edge.z);
        const bool a = isWhole(cell);
        const bool b = isWhole(cell - u);
        const bool c = isWhole(cell - v);
        const bool d = isWhole(cell - u - v);
        return (a && d && !b && !c) || (b && c && !a && !d);
    }

    const Lattice& lattice_;
    DenseField field_;
    double iso_;
    bool below_;
    ReferenceSurface surface_;
};

/// The order of the mesh's vertices, see the header.
std::array<int, 8> orderOf(const LatticeEdge& edge) {
    const int kind = edge.direction == 1 ? 0 : edge.direction == 2 ? 1 : edge.direction == 4 ? 2 : 3;
    return {edge.z / 8, edge.y / 8, edge.x / 8, edge.second, edge.x, edge.y, kind, edge.z};
}

double largestComponent(glm::dvec3 v) {
    return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

std::ostream& operator<<(std::ostream& out, const LatticeEdge& edge) {
    return out << "edge (" << edge.x << ", " << edge.y << ", " << edge.z << ") direction " << edge.direction;
}

}  // namespace

ReferenceSurface extractReference(const Lattice& lattice, std::span<const float> samples, float iso,
                                  bool insideIsBelow) {
    return Extractor(lattice, samples, iso, insideIsBelow).run();
}

std::string differenceFromReference(const SurfaceMesh& mesh, const ReferenceSurface& reference,
                                    double positionTolerance, double normalTolerance) {
    std::ostringstream difference;
    if (mesh.vertexCount() != reference.vertices.size() ||
        mesh.triangleCount() != reference.triangles.size()) {
        difference << mesh.vertexCount() << " vertices and " << mesh.triangleCount()
                   << " triangles instead of " << reference.vertices.size() << " and "
                   << reference.triangles.size();
        return difference.str();
    }
    std::vector<LatticeEdge> edges;
    for (const auto& [edge, vertex] : reference.vertices) edges.push_back(edge);
    std::ranges::sort(edges, {}, orderOf);
    for (std::size_t i = 0; i < edges.size(); ++i) {
        const ReferenceSurface::Vertex& wanted = reference.vertices.at(edges[i]);
        const glm::dvec3 position = glm::dvec3(mesh.positions[i]) + mesh.origin;
        const double positionError = largestComponent(position - wanted.position);
        const double normalError = largestComponent(glm::dvec3(mesh.normals[i]) - wanted.normal);
        // Where the gradient vanishes but for rounding, its direction is anyone's.
        const bool anyNormal = largestComponent(wanted.normal) <= normalTolerance || wanted.byEdge;
        if (!(positionError <= positionTolerance) || !(anyNormal || normalError <= normalTolerance)) {
            difference << edges[i] << ": position off by " << positionError << ", normal by " << normalError;
            return difference.str();
        }
    }
    std::set<ReferenceSurface::Triangle> triangles;
    for (std::size_t t = 0; t < mesh.triangles.size(); t += 3) {
        ReferenceSurface::Triangle triangle;
        for (std::size_t k = 0; k < 3; ++k) triangle[k] = edges[mesh.triangles[t + k]];
        std::rotate(triangle.begin(), std::min_element(triangle.begin(), triangle.end()), triangle.end());
        if (!reference.triangles.contains(triangle)) {
            difference << "a triangle that should not be, at " << triangle[0];
            return difference.str();
        }
        triangles.insert(triangle);
    }
    if (triangles.size() != reference.triangles.size()) difference << "triangles twice";
    return difference.str();
}

}  // namespace isoglass
