#include "surface/brick_surface.h"

#include "surface/brick_vertex.h"
#include "surface/cell_table.h"
#include "surface/height_vertex.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace isoglass {

namespace {

constexpr int kCorners = kBrickSize + 1;

/// The compact cell table, flat: edge number 0..11, or kBodyEdge.
struct FlatTable {
    std::array<std::array<std::uint8_t, 36>, 256> edges{};
    std::array<std::uint8_t, 256> triangles{};
    std::array<bool, 256> body{};
};

const FlatTable& flatTable() {
    static const FlatTable table = [] {
        FlatTable flat;
        for (int pattern = 0; pattern < 256; ++pattern) {
            const CellCase& cell = cellTable()[pattern];
            flat.triangles[pattern] = static_cast<std::uint8_t>(cell.compact.size());
            flat.body[pattern] = cell.needsBodyVertex();
            for (std::size_t t = 0; t < cell.compact.size(); ++t) {
                for (int k = 0; k < 3; ++k) flat.edges[pattern][3 * t + k] = cell.compact[t][k];
            }
        }
        return flat;
    }();
    return table;
}

/// Corner pattern of cell z in four rows of inside bits (x, y), (x+1, y), (x, y+1), (x+1, y+1).
struct CellRows {
    std::array<std::uint32_t, 4> row;

    int pattern(int z) const {
        int bits = 0;
        for (int corner = 0; corner < 4; ++corner) {
            const std::uint32_t pair = row[corner] >> z;
            bits |= static_cast<int>(pair & 1) << corner | static_cast<int>(pair >> 1 & 1) << (corner + 4);
        }
        return bits;
    }
    std::uint32_t any() const { return pairs(row[0] | row[1] | row[2] | row[3]); }
    std::uint32_t all() const {
        const std::uint32_t common = row[0] & row[1] & row[2] & row[3];
        return common & common >> 1;
    }

  private:
    static std::uint32_t pairs(std::uint32_t bits) { return bits | bits >> 1; }
};

template <typename Rows>
CellRows cellRows(const Rows& rows, int rowLength, int x, int y) {
    const int first = x * rowLength + y;
    return {{rows[first], rows[first + rowLength], rows[first + 1], rows[first + rowLength + 1]}};
}

/// Which cells have all eight samples, around a brick that touches the domain's end or missing samples.
class Validity {
  public:
    Validity(const IndexSpace& space, glm::ivec3 brick, const BrickField& field) {
        for (int x = -1; x <= kBrickSize; ++x) {
            for (int y = -1; y <= kBrickSize; ++y) {
                std::uint32_t bits = 0;
                for (int z = -1; z <= kBrickSize; ++z) {
                    bits |= static_cast<std::uint32_t>(!std::isnan(field.values[BrickField::at(x, y, z)]))
                            << (z + 1);
                }
                samples_[(x + 1) * kSamples + y + 1] = bits;
            }
        }
        std::array<std::uint32_t, 3> domain{};
        for (int axis = 0; axis < 3; ++axis) {
            for (int place = -1; place < kBrickSize; ++place) {
                const int cell = brick[axis] * kBrickSize + place;
                if (cell >= 0 && cell < space.cells[axis]) domain[axis] |= 1u << (place + 1);
            }
        }
        for (int x = 0; x < kCells; ++x) {
            for (int y = 0; y < kCells; ++y) {
                const bool inside = domain[0] >> x & 1 && domain[1] >> y & 1;
                domain_[x * kCells + y] = inside ? domain[2] : 0;
                cells_[x * kCells + y] = domain_[x * kCells + y] & cellRows(samples_, kSamples, x, y).all();
            }
        }
    }

    /// Bit z: cell (x, y, z) has all its samples.
    std::uint32_t cells(int x, int y) const { return at(x, y) >> 1 & 0xff; }

    /// Bit z: one of the four cells around the edge has all its samples.
    std::uint32_t edges(int x, int y, int kind) const {
        switch (kind) {
            case 0:
                return across(at(x, y - 1) | at(x, y));
            case 1:
                return across(at(x - 1, y) | at(x, y));
            default:
                return (at(x - 1, y - 1) | at(x - 1, y) | at(x, y - 1) | at(x, y)) >> 1 & 0xff;
        }
    }

    /// Bit z: of the four cells around the axis edge only two opposite ones have all their samples.
    std::uint32_t pinched(int x, int y, int kind) const {
        switch (kind) {
            case 0:
                return opposite(at(x, y - 1), at(x, y - 1) >> 1, at(x, y), at(x, y) >> 1);
            case 1:
                return opposite(at(x - 1, y), at(x - 1, y) >> 1, at(x, y), at(x, y) >> 1);
            default:
                return opposite(at(x - 1, y - 1), at(x - 1, y), at(x, y - 1), at(x, y)) >> 1;
        }
    }

    /// Bit z: cell (x, y, z) lacks a sample, and those it has lie on both sides. `inside` as in the record.
    std::uint32_t lost(const CellRows& inside, int x, int y) const {
        CellRows in = cellRows(samples_, kSamples, x + 1, y + 1);
        CellRows out = in;
        for (int corner = 0; corner < 4; ++corner) {
            in.row[corner] = in.row[corner] >> 1 & inside.row[corner];
            out.row[corner] = out.row[corner] >> 1 & ~inside.row[corner];
        }
        return in.any() & out.any() & ~cells(x, y) & domain_[(x + 1) * kCells + y + 1] >> 1 & 0xff;
    }

  private:
    static constexpr int kSamples = kBrickSize + 2;  // -1 .. 8
    static constexpr int kCells = kBrickSize + 1;    // -1 .. 7

    std::uint32_t at(int x, int y) const { return cells_[(x + 1) * kCells + y + 1]; }
    /// Of four cells around an edge, `a` lies opposite `d`.
    static std::uint32_t opposite(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
        return (a & d & ~b & ~c) | (b & c & ~a & ~d);
    }
    /// From cells z-1 (bit z) and z (bit z+1) to bit z.
    static std::uint32_t across(std::uint32_t cells) { return (cells | cells >> 1) & 0xff; }

    std::array<std::uint32_t, kSamples * kSamples> samples_;
    std::array<std::uint32_t, kCells * kCells> domain_;
    std::array<std::uint32_t, kCells * kCells> cells_;
};

void markInside(const BrickField& field, float iso, BrickRecord& record) {
    for (int x = 0; x < kCorners; ++x) {
        for (int y = 0; y < kCorners; ++y) {
            const float* row = &field.values[BrickField::at(x, y, 0)];
            std::uint32_t bits = 0;
            for (int z = 0; z < kCorners; ++z) bits |= static_cast<std::uint32_t>(row[z] >= iso) << z;
            record.inside[x * kCorners + y] = static_cast<std::uint16_t>(bits);
        }
    }
}

/// Marks crossed cells and edges, as if every sample were valid.
void markCrossings(BrickRecord& record) {
    for (int x = 0; x < kBrickSize; ++x) {
        for (int y = 0; y < kBrickSize; ++y) {
            const CellRows rows = cellRows(record.inside, kCorners, x, y);
            const int row = x * kBrickSize + y;
            record.cells[row] = static_cast<std::uint8_t>(rows.any() & ~rows.all());
            record.edges[row] = {static_cast<std::uint8_t>(rows.row[0] ^ rows.row[1]),
                                 static_cast<std::uint8_t>(rows.row[0] ^ rows.row[2]),
                                 static_cast<std::uint8_t>(rows.row[0] ^ rows.row[0] >> 1), 0};
        }
    }
}

void dropInvalid(const Validity& validity, BrickRecord& record) {
    for (int x = 0; x < kBrickSize; ++x) {
        for (int y = 0; y < kBrickSize; ++y) {
            const int row = x * kBrickSize + y;
            record.lostCells += std::popcount(validity.lost(cellRows(record.inside, kCorners, x, y), x, y));
            record.cells[row] &= static_cast<std::uint8_t>(validity.cells(x, y));
            for (int kind = 0; kind < 3; ++kind) {
                record.edges[row][kind] &= static_cast<std::uint8_t>(validity.edges(x, y, kind));
                for (std::uint32_t edges = record.edges[row][kind] & validity.pinched(x, y, kind); edges;
                     edges &= edges - 1) {
                    record.pinched.push_back({static_cast<std::uint8_t>(x), static_cast<std::uint8_t>(y),
                                              static_cast<std::uint8_t>(std::countr_zero(edges)),
                                              static_cast<std::uint8_t>(kind)});
                }
            }
        }
    }
}

/// Counts triangles and vertices, and marks the body diagonals that carry a vertex.
void count(BrickRecord& record) {
    const FlatTable& table = flatTable();
    int vertices = 0;
    int triangles = 0;
    for (int row = 0; row < kBrickSize * kBrickSize; ++row) {
        const CellRows rows = cellRows(record.inside, kCorners, row / kBrickSize, row % kBrickSize);
        for (std::uint32_t cells = record.cells[row]; cells; cells &= cells - 1) {
            const int z = std::countr_zero(cells);
            const int pattern = rows.pattern(z);
            triangles += table.triangles[pattern];
            if (table.body[pattern]) record.edges[row][3] |= static_cast<std::uint8_t>(1u << z);
        }
        record.rowStart[row] = static_cast<std::uint16_t>(vertices);
        vertices += std::popcount(std::bit_cast<std::uint32_t>(record.edges[row]));
    }
    record.vertexCount = static_cast<std::uint16_t>(vertices + record.pinched.size());
    record.triangleCount = static_cast<std::uint16_t>(triangles);
}

/// Half of `EdgeVertices::indices_`.
constexpr std::size_t kVertexSlots = std::size_t{kCorners} * kCorners * kCorners * kEdgeKinds;

constexpr int vertexSlot(int x, int y, int z) {
    return ((x * kCorners + y) * kCorners + z) * kEdgeKinds;
}

/// Notes the indices of the vertices of one row of `owner`, those at the z whose bits are set in `keep`.
void expandRow(const BrickRecord& owner, int x, int y, int firstZ, std::uint32_t keep,
               std::uint32_t* indices) {
    const int row = (x % kBrickSize) * kBrickSize + y % kBrickSize;
    if (!(std::bit_cast<std::uint32_t>(owner.edges[row]) & keep * 0x01010101u)) return;
    std::uint32_t index = owner.firstVertex + owner.rowStart[row];
    for (int kind = 0; kind < kEdgeKinds; ++kind) {
        for (std::uint32_t edges = owner.edges[row][kind]; edges; edges &= edges - 1, ++index) {
            const int z = std::countr_zero(edges);
            if (keep >> z & 1) indices[vertexSlot(x, y, z + firstZ) + kind] = index;
        }
    }
}

void expandVertices(const std::array<const BrickRecord*, 8>& neighbours, std::uint32_t* indices) {
    for (int x = 0; x < kCorners; ++x) {
        for (int y = 0; y < kCorners; ++y) {
            const int column = (x == kBrickSize ? 1 : 0) | (y == kBrickSize ? 2 : 0);
            if (neighbours[column]) expandRow(*neighbours[column], x, y, 0, 0xff, indices);
            if (neighbours[column | 4]) expandRow(*neighbours[column | 4], x, y, kBrickSize, 1, indices);
        }
    }
}

/// Fills the second half of the indices: as the first, but for pinched edges.
void expandPinched(const std::array<const BrickRecord*, 8>& neighbours, std::uint32_t* second) {
    expandVertices(neighbours, second);
    for (int k = 0; k < 8; ++k) {
        if (!neighbours[k]) continue;
        const BrickRecord& owner = *neighbours[k];
        auto index = static_cast<std::uint32_t>(owner.firstVertex + owner.vertexCount - owner.pinched.size());
        for (const PinchedEdge& edge : owner.pinched) {
            const int x = edge.x + (k & 1 ? kBrickSize : 0);
            const int y = edge.y + (k & 2 ? kBrickSize : 0);
            const int z = edge.z + (k & 4 ? kBrickSize : 0);
            if (std::max({x, y, z}) < kCorners) second[vertexSlot(x, y, z) + edge.kind] = index;
            ++index;
        }
    }
}

/// Places of a cell's 12 axis edges and its body diagonal among the indices, relative to the cell. Around an
/// axis edge, cells that lie before it along the first of the other two axes take the second half where
/// `pinched`: of two opposite cells, one does.
constexpr std::array<int, kCellEdges> makeEdgeSlots(bool pinched) {
    constexpr std::array<int, kCellEdges> kFirstCorner = {0, 2, 4, 6, 0, 1, 4, 5, 0, 1,
                                                          2, 3, 0, 0, 0, 0, 0, 0, 0};
    std::array<int, kCellEdges> slots{};
    for (int edge = 0; edge < kCellEdges; ++edge) {
        const int corner = kFirstCorner[edge];
        const int kind = edge < kAxisEdges ? edge / 4 : 3;
        slots[edge] = vertexSlot(corner & 1, corner >> 1 & 1, corner >> 2) + kind;
        const bool before = edge < kAxisEdges && corner >> (kind == 0 ? 1 : 0) & 1;
        if (pinched && before) slots[edge] += kVertexSlots;
    }
    return slots;
}

template <typename Maker>
void makeAllVertices(const BrickRecord& record, const Maker& maker, VertexBuffer& out) {
    constexpr std::array<int, kEdgeKinds> kDirections = {1, 2, 4, 7};
    for (int row = 0; row < kBrickSize * kBrickSize; ++row) {
        for (int kind = 0; kind < kEdgeKinds; ++kind) {
            for (std::uint32_t edges = record.edges[row][kind]; edges; edges &= edges - 1) {
                const glm::ivec3 low(row / kBrickSize, row % kBrickSize, std::countr_zero(edges));
                maker.make(low, kDirections[kind], out);
            }
        }
    }
    for (const PinchedEdge& edge : record.pinched)
        maker.make({edge.x, edge.y, edge.z}, kDirections[edge.kind], out);
}

}  // namespace

void classifyBrick(const IndexSpace& space, glm::ivec3 brick, const BrickField& field, float iso,
                   BrickRecord& record) {
    record.brick = brick;
    record.lostCells = 0;
    record.pinched.clear();
    markInside(field, iso, record);
    markCrossings(record);
    bool whole = field.complete;
    for (int k = 0; k < 3; ++k)
        whole = whole && brick[k] > 0 && (brick[k] + 1) * kBrickSize <= space.cells[k];
    if (!whole) dropInvalid(Validity(space, brick, field), record);
    count(record);
}

void makeVertices(const IndexSpace& space, const BrickRecord& record, const BrickField& field,
                  const BrickField* heights, float iso, VertexBuffer& out) {
    if (heights) {
        makeAllVertices(record, HeightVertexMaker(space, record.brick, field, *heights, iso), out);
    } else {
        makeAllVertices(record, VertexMaker(space, record.brick, field, iso), out);
    }
}

EdgeVertices::EdgeVertices(const std::array<const BrickRecord*, 8>& neighbours) {
    static constexpr std::array<int, kCellEdges> kPlainSlots = makeEdgeSlots(false);
    static constexpr std::array<int, kCellEdges> kPinchedSlots = makeEdgeSlots(true);
    expandVertices(neighbours, indices_.data());
    const bool pinched = std::ranges::any_of(
        neighbours, [](const BrickRecord* owner) { return owner && !owner->pinched.empty(); });
    if (pinched) expandPinched(neighbours, indices_.data() + kVertexSlots);
    edgeSlots_ = pinched ? kPinchedSlots.data() : kPlainSlots.data();
}

std::uint32_t EdgeVertices::at(glm::ivec3 cell, int edge) const {
    return indices_[vertexSlot(cell.x, cell.y, cell.z) + edgeSlots_[edge]];
}

void writeTriangles(const std::array<const BrickRecord*, 8>& neighbours, bool mirrored,
                    std::span<std::uint32_t> out) {
    const FlatTable& table = flatTable();
    const BrickRecord& record = *neighbours[0];
    const EdgeVertices vertices(neighbours);
    const int* edgeSlots = vertices.edgeSlots_;
    std::size_t place = 0;
    for (int row = 0; row < kBrickSize * kBrickSize; ++row) {
        const int x = row / kBrickSize;
        const int y = row % kBrickSize;
        const CellRows rows = cellRows(record.inside, kCorners, x, y);
        for (std::uint32_t cells = record.cells[row]; cells; cells &= cells - 1) {
            const int z = std::countr_zero(cells);
            const int pattern = rows.pattern(z);
            const std::uint32_t* cell = &vertices.indices_[vertexSlot(x, y, z)];
            const auto& edges = table.edges[pattern];
            for (int t = 0; t < 3 * table.triangles[pattern]; t += 3) {
                out[place++] = cell[edgeSlots[edges[t]]];
                out[place++] = cell[edgeSlots[edges[t + (mirrored ? 2 : 1)]]];
                out[place++] = cell[edgeSlots[edges[t + (mirrored ? 1 : 2)]]];
            }
        }
    }
}

}  // namespace isoglass
