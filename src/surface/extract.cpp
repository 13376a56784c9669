#include "surface/extract.h"

#include "base/error.h"
#include "basis/parallel.h"
#include "surface/brick_surface.h"
#include "surface/clip_mesh.h"
#include "surface/extract_view.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace isoglass {

namespace {

constexpr std::size_t kBricksPerRangeTask = 4096;
constexpr std::size_t kBricksPerTask = 32;
/// What a smooth surface makes in that many bricks, about 8^2 a brick; more only costs a reallocation.
constexpr std::size_t kVerticesPerTask = kBricksPerTask * kBrickSize * kBrickSize;
constexpr ValueRange kEmptyRange{std::numeric_limits<float>::infinity(),
                                 -std::numeric_limits<float>::infinity()};

/// Range of the field in a brick's cells at the time of `field`, widened by what rounding can do.
ValueRange rangeInTime(const TimedField& field, std::size_t brick) {
    if (field.fraction == 0) return field.a->range(brick);
    const ValueRange b = field.b->range(brick);
    if (field.fraction == 1) return b;
    const ValueRange a = field.a->range(brick);
    if (a.min > a.max || b.min > b.max) return kEmptyRange;  // no cell has all its samples
    const float s = field.fraction;
    const float magnitude = std::max({std::abs(a.min), std::abs(a.max), std::abs(b.min), std::abs(b.max)});
    // Each interpolated value carries two roundings, each of at most half an ulp of the magnitude; twice
    // that on either side is 4 ulp. The smallest float covers products that underflow.
    const float slack =
        4 * std::numeric_limits<float>::epsilon() * magnitude + std::numeric_limits<float>::denorm_min();
    return {a.min + s * (b.min - a.min) - slack, a.max + s * (b.max - a.max) + slack};
}

/// Bricks that the surface touches, in linear order, and where each row of bricks starts among them.
struct Selection {
    std::vector<std::uint32_t> bricks;
    std::vector<std::uint32_t> rowStart;  ///< by y + z * bricks.y, one more at the end
    ValueRange range = kEmptyRange;
    bool leftOut = false;  ///< see ExtractStats
};

/// What the view sees; all, where the options say that all is extracted.
ClipTest seenBy(const IndexSpace& space, const ExtractOptions& options, bool takeAll) {
    return {space, options.view && !takeAll ? std::span<const glm::dvec4>(options.view->planes)
                                            : std::span<const glm::dvec4>()};
}

Selection selectBricks(const IndexSpace& space, const TimedField& field, const ExtractOptions& options,
                       const ClipTest& seen) {
    const std::size_t rows = static_cast<std::size_t>(space.bricks.y) * space.bricks.z;
    const std::size_t rowsPerTask = std::max<std::size_t>(1, kBricksPerRangeTask / space.bricks.x);
    const ClipTest clip(space, options.clip);
    std::vector<Selection> parts((rows + rowsPerTask - 1) / rowsPerTask);
    std::vector<std::uint32_t> rowCount(rows + 1);
    const glm::ivec3 storedBricks = field.a->brickDims();
    parallelFor(rows, rowsPerTask, options.threads, [&](std::size_t begin, std::size_t end) {
        Selection& part = parts[begin / rowsPerTask];
        for (std::size_t row = begin; row < end; ++row) {
            const int y = static_cast<int>(row % space.bricks.y);
            const int z = static_cast<int>(row / space.bricks.y);
            const std::size_t before = part.bricks.size();
            for (int x = 0; x < space.bricks.x; ++x) {
                // The sample that closes a periodic axis may need a brick of its own: the first one again.
                const glm::ivec3 brick(x % storedBricks.x, y % storedBricks.y, z % storedBricks.z);
                const ValueRange range = rangeInTime(field, field.a->linear(brick));
                if (!(range.min <= range.max)) continue;
                part.range = {std::min(part.range.min, range.min), std::max(part.range.max, range.max)};
                if (!(range.min <= options.iso && options.iso <= range.max)) continue;
                if (clip.skips({x, y, z})) continue;
                if (seen.skips({x, y, z})) {
                    part.leftOut = true;
                } else {
                    part.bricks.push_back(static_cast<std::uint32_t>(row * space.bricks.x + x));
                }
            }
            rowCount[row] = static_cast<std::uint32_t>(part.bricks.size() - before);
        }
    });
    Selection all;
    for (const Selection& part : parts) {
        all.bricks.insert(all.bricks.end(), part.bricks.begin(), part.bricks.end());
        all.range = {std::min(all.range.min, part.range.min), std::max(all.range.max, part.range.max)};
        all.leftOut = all.leftOut || part.leftOut;
    }
    all.rowStart.assign(rows + 1, 0);
    for (std::size_t row = 0; row < rows; ++row) all.rowStart[row + 1] = all.rowStart[row] + rowCount[row];
    return all;
}

bool isCutBy(const ExtractOptions& options) {
    return !options.clip.empty() || options.closed;
}

/// Heights that one side has and the other lacks would put the surface somewhere else.
void requireHeights(const Lattice& lattice, const TimedField& field) {
    for (const auto& frame : {field.a, field.b}) {
        if (frame && (frame->heights() != nullptr) != lattice.heights.has_value())
            throw std::invalid_argument("lattice and key frames do not agree on heights");
    }
}

glm::ivec3 brickPosition(const IndexSpace& space, std::uint32_t linear) {
    return {linear % space.bricks.x, linear / space.bricks.x % space.bricks.y,
            linear / (static_cast<std::uint32_t>(space.bricks.x) * space.bricks.y)};
}

/// The heights of the samples at the time of `field`; nothing where the axis table says them.
std::optional<TimedField> heightsOf(const TimedField& field) {
    const KeyFrame& any = field.a ? *field.a : *field.b;
    if (!any.heights()) return std::nullopt;
    return TimedField{field.a ? field.a->heights() : nullptr, field.b ? field.b->heights() : nullptr,
                      field.fraction};
}

/// First pass: every touched brick is gathered once, classified, and its vertices are made.
void makeRecords(const IndexSpace& space, const TimedField& field, const ExtractOptions& options,
                 const ClipTest& seen, const Selection& selection, std::vector<BrickRecord>& records,
                 std::vector<VertexBuffer>& buffers) {
    const float sign = options.insideIsBelow ? -1.0f : 1.0f;
    const std::optional<TimedField> heightsInTime = heightsOf(field);
    records.resize(selection.bricks.size());
    buffers.resize((records.size() + kBricksPerTask - 1) / kBricksPerTask);
    parallelFor(records.size(), kBricksPerTask, options.threads, [&](std::size_t begin, std::size_t end) {
        BrickField gathered;
        BrickField scratch;
        BrickField heights;
        VertexBuffer& buffer = buffers[begin / kBricksPerTask];
        buffer.positions.reserve(kVerticesPerTask);
        buffer.normals.reserve(kVerticesPerTask);
        for (std::size_t i = begin; i < end; ++i) {
            const glm::ivec3 brick = brickPosition(space, selection.bricks[i]);
            gatherBrick(space, field, brick, sign, scratch, gathered);
            classifyBrick(space, brick, gathered, sign * options.iso, records[i]);
            if (heightsInTime) gatherBrick(space, *heightsInTime, brick, 1, scratch, heights);
            makeVertices(space, records[i], gathered, heightsInTime ? &heights : nullptr, sign * options.iso,
                         buffer);
            // Only its vertices are used, by the bricks before it.
            if (seen.hides(brick)) records[i].triangleCount = 0;
        }
    });
}

/// Second pass: gives every brick its place in the mesh.
void scan(std::vector<BrickRecord>& records, SurfaceMesh& mesh) {
    std::size_t vertices = 0;
    std::size_t triangles = 0;
    for (BrickRecord& record : records) {
        record.firstVertex = static_cast<std::uint32_t>(vertices);
        record.firstTriangle = static_cast<std::uint32_t>(triangles);
        vertices += record.vertexCount;
        triangles += record.triangleCount;
    }
    if (std::max(vertices, triangles) > std::numeric_limits<std::uint32_t>::max()) {
        throw std::length_error("the surface has more than 2^32 vertices or triangles");
    }
    mesh.positions.resize(vertices);
    mesh.normals.resize(vertices);
    mesh.triangles.resize(3 * triangles);
}

std::array<const BrickRecord*, 8> findNeighbours(const IndexSpace& space, const Selection& selection,
                                                 const std::vector<BrickRecord>& records, glm::ivec3 brick) {
    std::array<const BrickRecord*, 8> neighbours{};
    const auto& bricks = selection.bricks;
    for (int yz = 0; yz < 4; ++yz) {
        const int y = brick.y + (yz & 1);
        const int z = brick.z + (yz >> 1);
        if (y >= space.bricks.y || z >= space.bricks.z) continue;
        const std::size_t row = static_cast<std::size_t>(z) * space.bricks.y + y;
        const auto wanted = static_cast<std::uint32_t>(row * space.bricks.x + brick.x);
        const auto end = bricks.begin() + selection.rowStart[row + 1];
        auto found = std::lower_bound(bricks.begin() + selection.rowStart[row], end, wanted);
        if (found != end && *found == wanted) neighbours[yz << 1] = &records[found++ - bricks.begin()];
        if (found != end && *found == wanted + 1) neighbours[yz << 1 | 1] = &records[found - bricks.begin()];
    }
    return neighbours;
}

/// Third pass: copies vertices to their places and writes triangles, all places known.
void writeMesh(const IndexSpace& space, const ExtractOptions& options, const Selection& selection,
               const std::vector<BrickRecord>& records, const std::vector<VertexBuffer>& buffers,
               SurfaceMesh& mesh) {
    const ClipTest clip(space, options.clip);
    parallelFor(records.size(), kBricksPerTask, options.threads, [&](std::size_t begin, std::size_t end) {
        const VertexBuffer& buffer = buffers[begin / kBricksPerTask];
        const std::uint32_t firstVertex = records[begin].firstVertex;
        std::copy(buffer.positions.begin(), buffer.positions.end(), mesh.positions.begin() + firstVertex);
        std::copy(buffer.normals.begin(), buffer.normals.end(), mesh.normals.begin() + firstVertex);
        for (std::size_t i = begin; i < end; ++i) {
            const std::size_t firstIndex = std::size_t{3} * records[i].firstTriangle;
            const std::span<std::uint32_t> out(mesh.triangles.data() + firstIndex,
                                               3u * records[i].triangleCount);
            // Of a brick that is clipped away only the vertices are used, by the bricks before it.
            if (!out.empty() && !clip.hides(records[i].brick))
                writeTriangles(findNeighbours(space, selection, records, records[i].brick), space.mirrored,
                               out);
        }
    });
}

}  // namespace

bool hasDetail(const Lattice& lattice, const ExtractOptions& options) {
    return options.view && options.view->wantsDetail() && !lattice.heights && !isCutBy(options);
}

Extraction extractSurface(const Lattice& lattice, const TimedField& field, const ExtractOptions& options) {
    requireHeights(lattice, field);
    const bool isCut = isCutBy(options);
    if (isCut && lattice.heights) {
        throw Error("a lattice whose samples have heights of their own cannot be clipped or closed yet",
                    "clipping", "remove the clip planes and the closed boundary");
    }
    if (hasDetail(lattice, options)) return extractForView(lattice, field, options);
    const IndexSpace space(lattice);
    const ClipTest seen = seenBy(space, options, isCut || lattice.heights);
    const Selection selection = selectBricks(space, field, options, seen);
    Extraction result;
    result.mesh.origin = space.origin;
    result.stats.bricks = static_cast<std::size_t>(space.bricks.x) * space.bricks.y * space.bricks.z;
    result.stats.touchedBricks = selection.bricks.size();
    result.stats.range = selection.range;
    result.stats.leftOut = selection.leftOut;

    std::vector<BrickRecord> records;
    std::vector<VertexBuffer> buffers;
    makeRecords(space, field, options, seen, selection, records, buffers);
    for (const BrickRecord& record : records) result.stats.lostCells += record.lostCells;
    scan(records, result.mesh);
    writeMesh(space, options, selection, records, buffers, result.mesh);
    if (isCut) {
        const auto find = [&](glm::ivec3 brick) { return findNeighbours(space, selection, records, brick); };
        clipMesh(space, field, options, records, find, result);
    }
    return result;
}

}  // namespace isoglass
