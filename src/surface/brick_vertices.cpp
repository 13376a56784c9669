#include "surface/brick_vertices.h"

#include "surface/brick_vertex.h"
#include "surface/cell_table.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <utility>

namespace isoglass {

namespace {

/// Places of a cell's edges in the slots, relative to those of the cell's first corner.
constexpr std::array<int, kCellEdges> makeSlotOffsets() {
    std::array<int, kCellEdges> offsets{};
    for (int edge = 0; edge < kCellEdges; ++edge)
        offsets[edge] = 7 * cornerPlace(cornerOffset(kCellEdge[edge].corner)) + kCellEdge[edge].direction - 1;
    return offsets;
}
constexpr std::array<int, kCellEdges> kSlotOffsets = makeSlotOffsets();
constexpr int kTouchesNothing = 13;

bool usable(glm::vec3 v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z) && v != glm::vec3(0);
}

}  // namespace

FinerNeighbours finerNeighbours(const LevelSpace& space, const SizeField& sizes, LevelBrick node) {
    FinerNeighbours result;
    if (node.level == 0) return result;
    const glm::ivec3 bricks = (space.cellsAt(node.level) + (kBrickSize - 1)) / kBrickSize;
    std::array<bool, 27> finer{};
    for (int i = 0; i < 27; ++i) {
        const LevelBrick neighbour{node.level, node.brick + glm::ivec3(i / 9 - 1, i / 3 % 3 - 1, i % 3 - 1)};
        bool exists = i != kTouchesNothing;
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
            result.touch[i] |= finer[9 * step.x + 3 * step.y + step.z + kTouchesNothing];
        }
    }
    return result;
}

void BrickVertices::begin(BlendedBrick& brick, const FinerNeighbours& finer, float iso, bool keepPlaces,
                          MeshPart& out) {
    brick_ = &brick;
    finer_ = &finer;
    out_ = &out;
    iso_ = iso;
    keepPlaces_ = keepPlaces;
    first_ = static_cast<std::uint32_t>(out.positions.size());
    slots_.fill(kNone);
    places_.clear();
}

std::uint32_t& BrickVertices::slot(glm::ivec3 cell, std::uint8_t edge) {
    return slots_[7 * cornerPlace(cell) + kSlotOffsets[edge]];
}

/// Where an edge lies on the brick's boundary, as in FinerNeighbours.
int BrickVertices::touchOf(glm::ivec3 low, int direction) const {
    int touch = 0;
    for (int k = 0; k < 3; ++k) {
        const bool along = direction >> k & 1;
        touch = 3 * touch + 1 + (along ? 0 : low[k] == 0 ? -1 : low[k] == kBrickSize ? 1 : 0);
    }
    return touch;
}

std::uint32_t BrickVertices::onEdge(glm::ivec3 cell, std::uint8_t edge) {
    std::uint32_t& vertex = slot(cell, edge);
    if (vertex != kNone) return vertex;
    const int direction = kCellEdge[edge].direction;
    const glm::ivec3 low = cell + cornerOffset(kCellEdge[edge].corner);
    const glm::ivec3 along = cornerOffset(direction);
    const End a = endAt(low);
    const End b = endAt(low + along);
    const int touch = touchOf(low, direction);
    const LevelBrick node = brick_->node();
    const glm::ivec3 global = node.brick * kBrickSize + low;
    Made made;
    if (!finer_->touch[touch]) {
        made = crossing(a, b, node.level, global, direction);
    } else {
        const End m = middle(a, b);
        made = (a.value >= iso_) != (m.value >= iso_)
                   ? crossing(a, m, node.level - 1, 2 * global, direction)
                   : crossing(m, b, node.level - 1, 2 * global + along, direction);
    }
    return vertex = add(made, touch != kTouchesNothing);
}

std::uint32_t BrickVertices::onDiagonal(glm::ivec3 cell, std::uint8_t diagonal, std::uint8_t p,
                                        std::uint8_t q, float weight) {
    if (weight >= 1) return onEdge(cell, diagonal);
    std::uint32_t& vertex = slot(cell, diagonal);
    if (vertex != kNone) return vertex;
    // Lattice order, so that both cells at the face compute the same.
    if (&slot(cell, q) < &slot(cell, p)) std::swap(p, q);
    const CellEdge d = kCellEdge[diagonal];
    const glm::ivec3 low = cornerOffset(d.corner);
    const glm::ivec3 along = cornerOffset(d.direction);
    const int i = along.x ? 0 : 1;
    const int j = along.z ? 2 : 1;
    // Distance of an axis crossing from the diagonal in its face, signed, up to a factor.
    const auto side = [&](std::uint8_t edge) {
        const CellEdge e = kCellEdge[edge];
        const glm::ivec3 corner = cornerOffset(e.corner);
        const double t = parameter(cell + corner, e.direction);
        const glm::dvec3 at = glm::dvec3(corner - low) + t * glm::dvec3(cornerOffset(e.direction));
        return at[i] - at[j];
    };
    const double sideP = side(p);
    double share = sideP / (sideP - side(q));
    if (!(share >= 0 && share <= 1)) share = 0.5;
    const Made chord = slid(madeAt(onEdge(cell, p)), madeAt(onEdge(cell, q)), share);
    const glm::ivec3 global = brick_->node().brick * kBrickSize + cell + low;
    const Made crossed =
        crossing(endAt(cell + low), endAt(cell + low + along), brick_->node().level, global, d.direction);
    Made made = slid(chord, crossed, weight);
    made.place.key = crossed.place.key;
    return vertex = add(made, touchOf(cell + low, d.direction) != kTouchesNothing);
}

std::uint32_t BrickVertices::onBody(glm::ivec3 cell, std::uint8_t apex, float weight) {
    if (weight >= 1) return onEdge(cell, kBodyEdge);
    std::uint32_t& vertex = slot(cell, kBodyEdge);
    if (vertex != kNone) return vertex;
    const glm::ivec3 global = brick_->node().brick * kBrickSize + cell;
    const Made crossed = crossing(endAt(cell), endAt(cell + 1), brick_->node().level, global, 7);
    Made made = slid(madeAt(onEdge(cell, apex)), crossed, weight);
    made.place.key = crossed.place.key;
    return vertex = add(made, false);
}

void BrickVertices::addSplitSide(glm::ivec3 a, glm::ivec3 u, glm::ivec3 w, VertexPolygon& polygon) {
    const End endA = endAt(a);
    const End endU = endAt(u);
    const End endW = endAt(w);
    const int level = brick_->node().level - 1;
    const glm::ivec3 base = 2 * brick_->node().brick * kBrickSize;
    struct Middle {
        End end;
        glm::ivec3 vertex;  // of the next finer level
    };
    const Middle au{middle(endA, endU), base + a + u};
    const Middle aw{middle(endA, endW), base + a + w};
    const Middle uw{middle(endU, endW), base + u + w};
    const auto cross = [&](const Middle& one, const Middle& other) {
        const glm::ivec3 step = other.vertex - one.vertex;
        const bool forward = step.x + step.y + step.z > 0;
        const Middle& low = forward ? one : other;
        const Middle& high = forward ? other : one;
        const glm::ivec3 d = high.vertex - low.vertex;
        polygon.add(add(crossing(low.end, high.end, level, low.vertex, d.x | d.y << 1 | d.z << 2), true));
    };
    const auto sameSide = [&](const Middle& m) { return (m.end.value >= iso_) == (endA.value >= iso_); };
    if (sameSide(au)) cross(au, uw);
    if (sameSide(au) != sameSide(aw)) cross(au, aw);
    if (sameSide(aw)) cross(aw, uw);
}

/// Where the surface crosses an edge that is not split, from 0 to 1.
double BrickVertices::parameter(glm::ivec3 low, int direction) const {
    const auto& values = brick_->values();
    const double a = values[cornerPlace(low)];
    const double b = values[cornerPlace(low + cornerOffset(direction))];
    return (static_cast<double>(iso_) - a) / (b - a);
}

BrickVertices::End BrickVertices::endAt(glm::ivec3 corner) {
    return {brick_->values()[cornerPlace(corner)], brick_->channels(corner)};
}

/// What the finer lattice has there, bit by bit: where it touches, it is all prolongation.
BrickVertices::End BrickVertices::middle(const End& a, const End& b) {
    return {0.5f * (a.value + b.value),
            {0.5 * (a.channels.position + b.channels.position),
             0.5f * (a.channels.gradient + b.channels.gradient)}};
}

BrickVertices::Made BrickVertices::crossing(const End& low, const End& high, int level, glm::ivec3 lowVertex,
                                            int direction) const {
    // In double the difference of two floats neither overflows nor vanishes.
    const double difference = static_cast<double>(high.value) - low.value;
    const double t = (static_cast<double>(iso_) - low.value) / difference;
    const glm::dvec3 edge = high.channels.position - low.channels.position;
    const glm::vec3 normal =
        -(low.channels.gradient + static_cast<float>(t) * (high.channels.gradient - low.channels.gradient));
    Made made;
    made.position = low.channels.position + t * edge;
    made.normal = usable(normal) ? normal : edgeNormal(difference, edge);
    made.place.key = edgeKey(level, lowVertex, direction);
    if (keepPlaces_)
        made.place.index = static_cast<double>(1 << level) *
                           (glm::dvec3(lowVertex) + t * glm::dvec3(cornerOffset(direction)));
    return made;
}

BrickVertices::Made BrickVertices::slid(const Made& from, const Made& to, double weight) const {
    Made made;
    made.position = from.position + weight * (to.position - from.position);
    const glm::vec3 normal = from.normal + static_cast<float>(weight) * (to.normal - from.normal);
    made.normal = usable(normal) ? normal : to.normal;
    if (keepPlaces_) made.place.index = from.place.index + weight * (to.place.index - from.place.index);
    return made;
}

BrickVertices::Made BrickVertices::madeAt(std::uint32_t vertex) const {
    return {out_->positions[vertex], out_->normals[vertex], keepPlaces_ ? place(vertex) : Place{}};
}

std::uint32_t BrickVertices::add(const Made& made, bool shared) {
    return add(glm::vec3(made.position), made.normal, made.place, shared);
}

std::uint32_t BrickVertices::add(glm::vec3 position, glm::vec3 normal, const Place& place, bool shared) {
    const auto vertex = static_cast<std::uint32_t>(out_->positions.size());
    out_->positions.push_back(position);
    out_->normals.push_back(normal);
    if (shared) out_->shared.push_back({place.key, vertex});
    if (keepPlaces_) places_.push_back(place);
    return vertex;
}

}  // namespace isoglass
