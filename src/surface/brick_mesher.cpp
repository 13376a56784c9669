#include "surface/brick_mesher.h"

#include <glm/common.hpp>

#include <algorithm>
#include <bit>
#include <cmath>

namespace isoglass {

namespace {

/// Corners of a cell on its faces x = 0, x = 1, y = 0, y = 1, z = 0, z = 1, one bit a corner.
constexpr std::array<int, 6> kFaceCorners = {0x55, 0xaa, 0x33, 0xcc, 0x0f, 0xf0};

int cornersOf(std::uint8_t edge) {
    const CellEdge e = kCellEdge[edge];
    return 1 << e.corner | 1 << (e.corner | e.direction);
}

int pattern(const auto& table, const std::array<int, 4>& rows, int z) {
    int bits = 0;
    for (int corner = 0; corner < 4; ++corner) {
        const std::uint32_t pair = table[rows[corner]] >> z;
        bits |= static_cast<int>(pair & 1) << corner | static_cast<int>(pair >> 1 & 1) << (corner + 4);
    }
    return bits;
}

}  // namespace

BrickMesher::BrickMesher(const LevelFields& fields, const CellOptions& options)
    : fields_(fields), options_(options), iso_(fields.sign * options.iso) {}

void BrickMesher::mesh(LevelBrick node, MeshPart& out) {
    begin(node, out);
    markInside();
    for (int x = 0; x < cellEnd_.x; ++x) {
        for (int y = 0; y < cellEnd_.y; ++y) meshRow(x, y);
    }
    if (cuts_) domainCut_.dropUnused();
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
    vertices_.begin(brick_, finer_, iso_, cuts_, out);
    if (cuts_) domainCut_.begin(fields_.space.cells, vertices_, out);
    form_ = chooseForm();
}

/// Weights only where they differ within the brick.
BrickMesher::Form BrickMesher::chooseForm() {
    if (options_.form == CellForm::tetrahedral) return Form::tetrahedral;
    const float size = static_cast<float>(1 << node_.level);
    const SizeField& sizes = fields_.sizes;
    const FormRamp ramp(node_.level, fields_.space.top(), sizes.growthPerBrick());
    const float low = sizes.smallest(node_) / size;
    const float high = sizes.largest(node_) / size;
    if (ramp.isTetrahedral(low, high)) return Form::tetrahedral;
    if (ramp.isCompact(low, high)) {
        if (options_.gate == 0) return Form::compact;
        weights_.fill(0);
        return Form::sliding;
    }
    for (int place = 0; place < kBrickCorners; ++place)
        weights_[place] = ramp.weight(brick_.sizeRatio(place));
    return Form::sliding;
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
    const CellRows rows = {first, first + kCornersPerSide, first + 1, first + kCornersPerSide + 1};
    std::uint32_t any = 0;
    std::uint32_t all = ~0u;
    std::uint32_t valid = ~0u;
    for (const int row : rows) {
        any |= inside_[row];
        all &= inside_[row];
        if (brick_.hasMissing()) valid &= valid_[row];
    }
    const std::uint32_t domain = (1u << cellEnd_.z) - 1;
    const std::uint32_t whole = valid & valid >> 1;
    for (std::uint32_t cells = (any | any >> 1) & ~(all & all >> 1) & whole & domain; cells;
         cells &= cells - 1) {
        const int z = std::countr_zero(cells);
        meshCell({x, y, z}, pattern(inside_, rows, z));
    }
    if (brick_.hasMissing()) countLost(rows, ~whole & domain);
}

void BrickMesher::countLost(const CellRows& rows, std::uint32_t cells) {
    for (; cells; cells &= cells - 1) {
        const int z = std::countr_zero(cells);
        const int known = pattern(valid_, rows, z);
        const int in = pattern(inside_, rows, z) & known;
        out_->lostCells += in != 0 && in != known;
    }
}

void BrickMesher::meshCell(glm::ivec3 cell, int insideCorners) {
    const CellCase& cellCase = cellTable()[insideCorners];
    switch (form_) {
        case Form::compact:
            for (const auto& t : cellCase.compact) {
                addTriangle(cell, t,
                            {vertices_.onEdge(cell, t[0]), vertices_.onEdge(cell, t[1]),
                             vertices_.onEdge(cell, t[2])});
            }
            break;
        case Form::tetrahedral:
            meshTetrahedra(cell, cellCase);
            break;
        case Form::sliding:
            meshSliding(cell, cellCase);
            break;
    }
}

void BrickMesher::meshTetrahedra(glm::ivec3 cell, const CellCase& cellCase) {
    for (const CellCase::Row& row : cellCase.rows) {
        const std::uint32_t p = vertices_.onEdge(cell, row.p);
        const std::uint32_t q = vertices_.onEdge(cell, row.q);
        const std::uint32_t x = vertices_.onEdge(cell, row.x);
        if (row.diagonal < 0) {
            addTriangle(cell, {row.p, row.q, row.x}, {p, q, x});
            continue;
        }
        const auto diagonal = static_cast<std::uint8_t>(row.diagonal);
        const std::uint32_t d = vertices_.onEdge(cell, diagonal);
        addTriangle(cell, {row.p, diagonal, row.x}, {p, d, x});
        addTriangle(cell, {diagonal, row.q, row.x}, {d, q, x});
    }
}

std::array<float, 8> BrickMesher::cornerValues(glm::ivec3 cell) const {
    std::array<float, 8> values;
    for (int corner = 0; corner < 8; ++corner)
        values[corner] = brick_.values()[cornerPlace(cell + cornerOffset(corner))] - iso_;
    return values;
}

/// The largest weight in the face of the diagonal, so that both cells at the face say the same.
float BrickMesher::faceWeight(std::uint8_t diagonal, const std::array<float, 8>& weights,
                              const std::array<float, 8>& values) const {
    const CellEdge d = kCellEdge[diagonal];
    const int along = d.direction & -d.direction;  // one of the two axes of the face
    const std::array<int, 4> face = {d.corner, d.corner | d.direction, d.corner | along,
                                     d.corner | (d.direction ^ along)};
    float weight = 0;
    for (const int corner : face) weight = std::max(weight, weights[corner]);
    if (options_.gate == 0 || weight >= 1) return weight;
    return std::max(weight, faceGate({values[face[0]], values[face[1]]}, {values[face[2]], values[face[3]]}));
}

void BrickMesher::meshSliding(glm::ivec3 cell, const CellCase& cellCase) {
    std::array<float, 8> weights;
    for (int corner = 0; corner < 8; ++corner)
        weights[corner] = weights_[cornerPlace(cell + cornerOffset(corner))];
    const std::array<float, 8> values = options_.gate > 0 ? cornerValues(cell) : std::array<float, 8>{};
    std::array<float, 12> faceWeights{};
    float bodyWeight = *std::max_element(weights.begin(), weights.end());
    for (std::size_t i = 0; i < cellCase.rows.size(); ++i) {
        if (cellCase.rows[i].diagonal < 0) continue;
        faceWeights[i] = faceWeight(static_cast<std::uint8_t>(cellCase.rows[i].diagonal), weights, values);
        bodyWeight = std::max(bodyWeight, faceWeights[i]);
    }
    if (cellCase.crossesBody && options_.gate > 0)
        bodyWeight = std::max(bodyWeight, bodyGate(values, options_.gate));

    // The crossing that the body vertex starts from, or itself where there is none.
    const bool hasApex = cellCase.apex >= 0;
    const auto apex = static_cast<std::uint8_t>(cellCase.apex);
    const std::uint8_t bodyEdge = hasApex && bodyWeight == 0 ? apex : kBodyEdge;
    std::uint32_t body = 0;
    if (cellCase.crossesBody) {
        body = hasApex && bodyWeight > 0 ? vertices_.onBody(cell, apex, bodyWeight)
                                         : vertices_.onEdge(cell, bodyEdge);
    }
    for (std::size_t i = 0; i < cellCase.rows.size(); ++i) {
        const CellCase::Row& row = cellCase.rows[i];
        const bool toBody = row.x == kBodyEdge;
        const std::uint8_t xEdge = toBody ? bodyEdge : row.x;
        const std::uint32_t x = toBody ? body : vertices_.onEdge(cell, row.x);
        const std::uint32_t p = vertices_.onEdge(cell, row.p);
        const std::uint32_t q = vertices_.onEdge(cell, row.q);
        if (row.diagonal < 0 || faceWeights[i] == 0) {
            if (x != p && x != q) addTriangle(cell, {row.p, row.q, xEdge}, {p, q, x});
            continue;
        }
        const auto diagonal = static_cast<std::uint8_t>(row.diagonal);
        const std::uint32_t d = vertices_.onDiagonal(cell, diagonal, row.p, row.q, faceWeights[i]);
        if (x != p) addTriangle(cell, {row.p, diagonal, xEdge}, {p, d, x});
        if (x != q) addTriangle(cell, {diagonal, row.q, xEdge}, {d, q, x});
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

void BrickMesher::addTriangle(glm::ivec3 cell, const std::array<std::uint8_t, 3>& edges,
                              const std::array<std::uint32_t, 3>& vertices) {
    if (!finer_.any && !cuts_) {
        const bool mirrored = fields_.space.levels[0].mirrored;
        out_->triangles.insert(out_->triangles.end(),
                               {vertices[0], vertices[mirrored ? 2 : 1], vertices[mirrored ? 1 : 2]});
        return;
    }
    const int splitFaces = splitFacesOf(cell);
    const int axes = cutAxesOf(cell);
    VertexPolygon polygon;
    int fanFrom = 0;
    if (splitFaces == 0) {
        for (const std::uint32_t vertex : vertices) polygon.add(vertex);
    } else {
        std::array<int, 3> places{};
        unsigned splitSides = 0;
        for (int side = 0; side < 3; ++side) {
            places[side] = polygon.size;
            polygon.add(vertices[side]);
            addSplitSide(cell, splitFaces, edges[side], edges[(side + 1) % 3], polygon);
            if (polygon.size > places[side] + 1) splitSides |= 1u << side;
        }
        // The points of a side are in line: a fan from the opposite corner, or from a point of one of two
        // such sides, does not end in slivers.
        if (splitSides != 0) {
            const int first = std::countr_zero(splitSides);
            fanFrom = std::has_single_bit(splitSides) ? places[(first + 2) % 3] : places[first] + 1;
        }
    }
    for (int k = 0; k < 3; ++k) {
        if (axes >> k & 1) polygon = domainCut_.cut(polygon, k);
    }
    addFan(polygon, axes == 0 ? fanFrom : 0);
}

/// Where the side between two crossings runs through a triangle of a split face, adds those with the inner
/// edges of that triangle.
void BrickMesher::addSplitSide(glm::ivec3 cell, int splitFaces, std::uint8_t from, std::uint8_t to,
                               VertexPolygon& polygon) {
    const int corners = cornersOf(from) | cornersOf(to);
    if (std::popcount(static_cast<unsigned>(corners)) != 3) return;
    bool split = false;
    for (int face = 0; face < 6; ++face)
        split |= (splitFaces >> face & 1) && (corners & kFaceCorners[face]) == corners;
    if (!split) return;
    const int common = cornersOf(from) & cornersOf(to);
    const auto only = [&](int bits) {
        return cell + cornerOffset(std::countr_zero(static_cast<unsigned>(bits)));
    };
    vertices_.addSplitSide(only(common), only(cornersOf(from) & ~common), only(cornersOf(to) & ~common),
                           polygon);
}

void BrickMesher::addFan(const VertexPolygon& polygon, int fanFrom) {
    const bool mirrored = fields_.space.levels[0].mirrored;
    const auto at = [&](int i) { return polygon.vertices[(fanFrom + i) % polygon.size]; };
    for (int i = 1; i + 1 < polygon.size; ++i) {
        out_->triangles.insert(out_->triangles.end(),
                               {at(0), at(mirrored ? i + 1 : i), at(mirrored ? i : i + 1)});
    }
}

}  // namespace isoglass
