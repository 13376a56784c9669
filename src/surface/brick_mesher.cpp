#include "surface/brick_mesher.h"

#include "surface/brick_vertex.h"
#include "surface/cell_table.h"

#include <glm/common.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace isoglass {

namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

/// Corners of a cell on its faces x = 0, x = 1, y = 0, y = 1, z = 0, z = 1, one bit a corner.
constexpr std::array<int, 6> kFaceCorners = {0x55, 0xaa, 0x33, 0xcc, 0x0f, 0xf0};

constexpr glm::ivec3 cornerOffset(int corner) {
    return {corner & 1, corner >> 1 & 1, corner >> 2};
}

/// Places of a cell's edges in `slots_`, relative to those of the cell's first corner.
constexpr std::array<int, kCellEdges> makeSlotOffsets() {
    std::array<int, kCellEdges> offsets{};
    for (int edge = 0; edge < kCellEdges; ++edge)
        offsets[edge] = 7 * cornerPlace(cornerOffset(kCellEdge[edge].corner)) + kCellEdge[edge].direction - 1;
    return offsets;
}

int cornersOf(std::uint8_t edge) {
    const CellEdge e = kCellEdge[edge];
    return 1 << e.corner | 1 << (e.corner | e.direction);
}

/// -1 where both ends of an edge lie on the brick's lower face of the axis, 1 on the upper one, else 0.
int touchOf(int low, bool along) {
    if (along) return 0;
    return low == 0 ? -1 : low == kBrickSize ? 1 : 0;
}

bool isFinite(glm::vec3 v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

}  // namespace

FinerNeighbours finerNeighbours(const LevelSpace& space, const SizeField& sizes, LevelBrick node) {
    FinerNeighbours result;
    if (node.level == 0) return result;
    const glm::ivec3 bricks = (space.cellsAt(node.level) + (kBrickSize - 1)) / kBrickSize;
    std::array<bool, 27> finer{};
    for (int i = 0; i < 27; ++i) {
        const glm::ivec3 step(i / 9 - 1, i / 3 % 3 - 1, i % 3 - 1);
        const LevelBrick neighbour{node.level, node.brick + step};
        bool exists = i != 13;
        for (int k = 0; k < 3; ++k)
            exists = exists && neighbour.brick[k] >= 0 && neighbour.brick[k] < bricks[k];
        finer[i] = exists && !sizes.isCoarseEnough(neighbour);
        result.any |= finer[i];
    }
    if (!result.any) return result;
    for (int i = 0; i < 27; ++i) {
        const glm::ivec3 touch(i / 9 - 1, i / 3 % 3 - 1, i % 3 - 1);
        for (int part = 1; part < 8; ++part) {
            const glm::ivec3 step = touch * cornerOffset(part);
            result.touch[i] |= finer[9 * step.x + 3 * step.y + step.z + 13];
        }
    }
    return result;
}

void BrickMesher::mesh(LevelBrick node, MeshPart& out) {
    begin(node, out);
    markInside();
    for (int x = 0; x < cellEnd_.x; ++x) {
        for (int y = 0; y < cellEnd_.y; ++y) meshRow(x, y);
    }
    if (cuts_) dropUnused();
}

void BrickMesher::begin(LevelBrick node, MeshPart& out) {
    node_ = node;
    out_ = &out;
    brick_.load(fields_, node);
    finer_ = finerNeighbours(fields_.space, fields_.sizes, node);
    cellEnd_ = glm::min(fields_.space.cellsAt(node.level) - node.brick * kBrickSize, glm::ivec3(kBrickSize));
    cuts_ = false;
    for (int k = 0; k < 3; ++k)
        cuts_ |= (node.brick[k] * kBrickSize + cellEnd_[k]) << node.level > fields_.space.cells[k];
    slots_.fill(kNone);
    firstVertex_ = static_cast<std::uint32_t>(out.positions.size());
    firstTriangle_ = out.triangles.size();
    firstShared_ = out.shared.size();
    indices_.clear();
    keys_.clear();
    cutVertices_.clear();
}

void BrickMesher::markInside() {
    const float* value = brick_.values().data();
    for (std::size_t row = 0; row < inside_.size(); ++row, value += kCornersPerSide) {
        std::uint32_t bits = 0;
        for (int z = 0; z < kCornersPerSide; ++z) bits |= static_cast<std::uint32_t>(value[z] >= iso_) << z;
        inside_[row] = bits;
        if (!brick_.hasMissing()) continue;
        bits = 0;
        for (int z = 0; z < kCornersPerSide; ++z)
            bits |= static_cast<std::uint32_t>(!std::isnan(value[z])) << z;
        valid_[row] = bits;
    }
}

void BrickMesher::meshRow(int x, int y) {
    const int first = x * kCornersPerSide + y;
    const std::array<int, 4> rows = {first, first + kCornersPerSide, first + 1, first + kCornersPerSide + 1};
    std::uint32_t any = 0;
    std::uint32_t all = ~0u;
    std::uint32_t valid = ~0u;
    for (const int row : rows) {
        any |= inside_[row];
        all &= inside_[row];
        if (brick_.hasMissing()) valid &= valid_[row];
    }
    const std::uint32_t domain = (1u << cellEnd_.z) - 1;
    const auto pattern = [&](const auto& table, int z) {
        int bits = 0;
        for (int corner = 0; corner < 4; ++corner) {
            const std::uint32_t pair = table[rows[corner]] >> z;
            bits |= static_cast<int>(pair & 1) << corner | static_cast<int>(pair >> 1 & 1) << (corner + 4);
        }
        return bits;
    };
    const std::uint32_t whole = valid & valid >> 1;
    for (std::uint32_t cells = (any | any >> 1) & ~(all & all >> 1) & whole & domain; cells;
         cells &= cells - 1) {
        const int z = std::countr_zero(cells);
        meshCell({x, y, z}, pattern(inside_, z));
    }
    if (!brick_.hasMissing()) return;
    for (std::uint32_t cells = ~whole & domain; cells; cells &= cells - 1) {
        const int z = std::countr_zero(cells);
        const int known = pattern(valid_, z);
        const int in = pattern(inside_, z) & known;
        out_->lostCells += in != 0 && in != known;
    }
}

void BrickMesher::meshCell(glm::ivec3 cell, int pattern) {
    for (const CellCase::Row& row : cellTable()[pattern].rows) {
        if (row.diagonal < 0) {
            addTriangle(cell, {row.p, row.q, row.x});
        } else {
            const auto diagonal = static_cast<std::uint8_t>(row.diagonal);
            addTriangle(cell, {row.p, diagonal, row.x});
            addTriangle(cell, {diagonal, row.q, row.x});
        }
    }
}

/// Faces of the cell that lie in a face of the brick with smaller cells behind it, one bit a face.
int BrickMesher::splitFacesOf(glm::ivec3 cell) const {
    int faces = 0;
    if (!finer_.any) return faces;
    for (int k = 0; k < 3; ++k) {
        if (cell[k] == 0 && finer_.face(k, -1)) faces |= 1 << (2 * k);
        if (cell[k] == kBrickSize - 1 && finer_.face(k, 1)) faces |= 2 << (2 * k);
    }
    return faces;
}

/// Axes along which the domain ends inside the cell.
int BrickMesher::cutAxesOf(glm::ivec3 cell) const {
    int axes = 0;
    if (!cuts_) return axes;
    for (int k = 0; k < 3; ++k) {
        const int end = (node_.brick[k] * kBrickSize + cell[k] + 1) << node_.level;
        axes |= static_cast<int>(end > fields_.space.cells[k]) << k;
    }
    return axes;
}

void BrickMesher::addTriangle(glm::ivec3 cell, const std::array<std::uint8_t, 3>& edges) {
    Polygon polygon;
    const int splitFaces = splitFacesOf(cell);
    std::array<int, 3> cornerPlaces{};
    int splitSides = 0;
    for (int side = 0; side < 3; ++side) {
        cornerPlaces[side] = polygon.size;
        polygon.add(vertexOn(cell, edges[side]));
        if (splitFaces == 0) continue;
        addSplitSide(cell, splitFaces, edges[side], edges[(side + 1) % 3], polygon);
        if (polygon.size > cornerPlaces[side] + 1) splitSides |= 1 << side;
    }
    // The points of a side are in line: a fan from the opposite corner, or from a point of one of two such
    // sides, does not end in slivers.
    int fanFrom = 0;
    if (splitSides != 0) {
        const int first = std::countr_zero(static_cast<unsigned>(splitSides));
        fanFrom = std::has_single_bit(static_cast<unsigned>(splitSides)) ? cornerPlaces[(first + 2) % 3]
                                                                         : cornerPlaces[first] + 1;
    }
    const int axes = cutAxesOf(cell);
    for (int k = 0; k < 3; ++k) {
        if (axes >> k & 1) polygon = cut(polygon, k);
    }
    addPolygon(polygon, axes == 0 ? fanFrom : 0);
}

void BrickMesher::addPolygon(const Polygon& polygon, int fanFrom) {
    const auto at = [&](int i) { return polygon.vertices[(fanFrom + i) % polygon.size]; };
    for (int i = 1; i + 1 < polygon.size; ++i) {
        out_->triangles.insert(out_->triangles.end(),
                               {at(0), at(mirrored_ ? i + 1 : i), at(mirrored_ ? i : i + 1)});
    }
}

std::uint32_t BrickMesher::vertexOn(glm::ivec3 cell, std::uint8_t edge) {
    static constexpr std::array<int, kCellEdges> kSlotOffsets = makeSlotOffsets();
    std::uint32_t& vertex = slots_[7 * cornerPlace(cell) + kSlotOffsets[edge]];
    if (vertex == kNone) {
        const CellEdge e = kCellEdge[edge];
        vertex = makeEdgeVertex(cell + cornerOffset(e.corner), e.direction);
    }
    return vertex;
}

/// An edge that smaller cells share is split: the half that is crossed carries the vertex.
std::uint32_t BrickMesher::makeEdgeVertex(glm::ivec3 low, int direction) {
    const glm::ivec3 along = cornerOffset(direction);
    const End a = endAt(low);
    const End b = endAt(low + along);
    int touch = 0;
    for (int k = 0; k < 3; ++k) touch = 3 * touch + touchOf(low[k], along[k] != 0) + 1;
    const bool shared = touch != 13;
    const glm::ivec3 global = node_.brick * kBrickSize + low;
    if (!finer_.touch[touch]) return addCrossing(a, b, node_.level, global, direction, shared);
    const End m = middle(a, b);
    if ((a.value >= iso_) != (m.value >= iso_))
        return addCrossing(a, m, node_.level - 1, 2 * global, direction, shared);
    return addCrossing(m, b, node_.level - 1, 2 * global + along, direction, shared);
}

/// Where the side between the crossings with `from` and `to` runs through a triangle of a split face, adds
/// the crossings with the three inner edges of that triangle. The signs alone give their order.
void BrickMesher::addSplitSide(glm::ivec3 cell, int splitFaces, std::uint8_t from, std::uint8_t to,
                               Polygon& polygon) {
    const int corners = cornersOf(from) | cornersOf(to);
    if (std::popcount(static_cast<unsigned>(corners)) != 3) return;
    bool split = false;
    for (int face = 0; face < 6; ++face)
        split |= (splitFaces >> face & 1) && (corners & kFaceCorners[face]) == corners;
    if (!split) return;
    const int common = cornersOf(from) & cornersOf(to);
    const auto cornerOf = [](int bits) {
        return cornerOffset(std::countr_zero(static_cast<unsigned>(bits)));
    };
    const glm::ivec3 cornerA = cell + cornerOf(common);
    const glm::ivec3 cornerU = cell + cornerOf(cornersOf(from) & ~common);
    const glm::ivec3 cornerW = cell + cornerOf(cornersOf(to) & ~common);
    const End a = endAt(cornerA);
    const End u = endAt(cornerU);
    const End w = endAt(cornerW);
    const glm::ivec3 base = 2 * node_.brick * kBrickSize;
    struct Middle {
        End end;
        glm::ivec3 vertex;  // of the next finer level
    };
    const Middle au{middle(a, u), base + cornerA + cornerU};
    const Middle aw{middle(a, w), base + cornerA + cornerW};
    const Middle uw{middle(u, w), base + cornerU + cornerW};
    const auto cross = [&](const Middle& one, const Middle& other) {
        const glm::ivec3 step = other.vertex - one.vertex;
        const bool forward = step.x + step.y + step.z > 0;
        const Middle& low = forward ? one : other;
        const Middle& high = forward ? other : one;
        const glm::ivec3 d = high.vertex - low.vertex;
        polygon.add(
            addCrossing(low.end, high.end, node_.level - 1, low.vertex, d.x | d.y << 1 | d.z << 2, true));
    };
    const auto sameSide = [&](const Middle& m) { return (m.end.value >= iso_) == (a.value >= iso_); };
    if (sameSide(au)) cross(au, uw);
    if (sameSide(au) != sameSide(aw)) cross(au, aw);
    if (sameSide(aw)) cross(aw, uw);
}

/// Keeps what lies in the domain (Sutherland and Hodgman 1974).
BrickMesher::Polygon BrickMesher::cut(const Polygon& polygon, int axis) {
    const double end = fields_.space.cells[axis];
    const auto isInside = [&](std::uint32_t vertex) { return indices_[vertex - firstVertex_][axis] <= end; };
    Polygon kept;
    for (int i = 0; i < polygon.size; ++i) {
        const std::uint32_t a = polygon.vertices[i];
        const std::uint32_t b = polygon.vertices[(i + 1) % polygon.size];
        if (isInside(a)) kept.add(a);
        if (isInside(a) != isInside(b)) kept.add(cutSide(a, b, axis));
    }
    return kept;
}

std::uint32_t BrickMesher::cutSide(std::uint32_t a, std::uint32_t b, int axis) {
    if (keys_[b - firstVertex_] < keys_[a - firstVertex_]) std::swap(a, b);
    const VertexKey key = cutKey(keys_[a - firstVertex_], keys_[b - firstVertex_], axis);
    const auto [found, isNew] = cutVertices_.try_emplace(key, kNone);
    if (!isNew) return found->second;
    const glm::dvec3 from = indices_[a - firstVertex_];
    const glm::dvec3 step = indices_[b - firstVertex_] - from;
    const double end = fields_.space.cells[axis];
    const double t = (end - from[axis]) / step[axis];
    glm::dvec3 index = from + t * step;
    index[axis] = end;
    const auto mix = [t](glm::vec3 low, glm::vec3 high) {
        return glm::vec3(glm::dvec3(low) + t * (glm::dvec3(high) - glm::dvec3(low)));
    };
    const glm::vec3 position = mix(out_->positions[a], out_->positions[b]);
    const glm::vec3 normal = mix(out_->normals[a], out_->normals[b]);
    const bool usable = isFinite(normal) && normal != glm::vec3(0);
    found->second = addVertex(position, usable ? normal : out_->normals[a], key, true, index);
    return found->second;
}

/// Vertices that cuts left behind go.
void BrickMesher::dropUnused() {
    std::vector<std::uint32_t> place(out_->positions.size() - firstVertex_, kNone);
    for (std::size_t i = firstTriangle_; i < out_->triangles.size(); ++i)
        place[out_->triangles[i] - firstVertex_] = 0;
    std::uint32_t next = firstVertex_;
    for (std::size_t i = 0; i < place.size(); ++i) {
        if (place[i] == kNone) continue;
        out_->positions[next] = out_->positions[firstVertex_ + i];
        out_->normals[next] = out_->normals[firstVertex_ + i];
        place[i] = next++;
    }
    out_->positions.resize(next);
    out_->normals.resize(next);
    for (std::size_t i = firstTriangle_; i < out_->triangles.size(); ++i)
        out_->triangles[i] = place[out_->triangles[i] - firstVertex_];
    const auto begin = out_->shared.begin() + static_cast<std::ptrdiff_t>(firstShared_);
    const auto unused = [&](const MeshPart::Shared& entry) {
        return place[entry.vertex - firstVertex_] == kNone;
    };
    out_->shared.erase(std::remove_if(begin, out_->shared.end(), unused), out_->shared.end());
    for (std::size_t i = firstShared_; i < out_->shared.size(); ++i)
        out_->shared[i].vertex = place[out_->shared[i].vertex - firstVertex_];
}

BrickMesher::End BrickMesher::endAt(glm::ivec3 corner) {
    return {brick_.values()[cornerPlace(corner)], brick_.channels(corner)};
}

/// What the finer lattice has there, bit by bit: where it touches, it is all prolongation.
BrickMesher::End BrickMesher::middle(const End& a, const End& b) {
    return {0.5f * (a.value + b.value),
            {0.5 * (a.channels.position + b.channels.position),
             0.5f * (a.channels.gradient + b.channels.gradient)}};
}

std::uint32_t BrickMesher::addCrossing(const End& low, const End& high, int level, glm::ivec3 lowVertex,
                                       int direction, bool shared) {
    // In double the difference of two floats neither overflows nor vanishes.
    const double difference = static_cast<double>(high.value) - low.value;
    const double t = (static_cast<double>(iso_) - low.value) / difference;
    const glm::dvec3 edge = high.channels.position - low.channels.position;
    const glm::vec3 position(low.channels.position + t * edge);
    const glm::vec3 normal =
        -(low.channels.gradient + static_cast<float>(t) * (high.channels.gradient - low.channels.gradient));
    const bool usable = isFinite(normal) && normal != glm::vec3(0);
    const glm::dvec3 index = cuts_ ? static_cast<double>(1 << level) *
                                         (glm::dvec3(lowVertex) + t * glm::dvec3(cornerOffset(direction)))
                                   : glm::dvec3(0);
    return addVertex(position, usable ? normal : edgeNormal(difference, edge),
                     edgeKey(level, lowVertex, direction), shared, index);
}

std::uint32_t BrickMesher::addVertex(glm::vec3 position, glm::vec3 normal, VertexKey key, bool shared,
                                     glm::dvec3 index) {
    const auto vertex = static_cast<std::uint32_t>(out_->positions.size());
    out_->positions.push_back(position);
    out_->normals.push_back(normal);
    if (shared) out_->shared.push_back({key, vertex});
    if (cuts_) {
        indices_.push_back(index);
        keys_.push_back(key);
    }
    return vertex;
}

}  // namespace isoglass
