#include "surface/extract_view.h"

#include "basis/parallel.h"
#include "surface/brick_mesher.h"
#include "surface/clip_mesh.h"
#include "surface/time_range.h"
#include "volume/pyramid.h"

#include <glm/common.hpp>

#include <memory>

namespace isoglass {

namespace {

constexpr std::size_t kBricksPerTask = 32;
/// See CellOptions.
constexpr float kGateInMotion = 0.03f;
/// What a smooth surface makes in that many bricks, about 8^2 vertices and twice as many triangles a brick;
/// more only costs a reallocation.
constexpr std::size_t kVerticesPerTask = kBricksPerTask * kBrickSize * kBrickSize;

/// Walks the octree from the top.
class Selector {
  public:
    Selector(const LevelSpace& space, const SizeField& sizes, const std::vector<TimedField>& levels,
             float iso, std::span<const glm::dvec4> planes)
        : space_(space), sizes_(sizes), levels_(levels), iso_(iso), seen_(space.levels[0], planes) {}

    LevelSelection run() {
        visit({space_.top(), glm::ivec3(0)});
        return std::move(selection_);
    }

  private:
    bool holdsIso(ValueRange range) const { return range.min <= iso_ && iso_ <= range.max; }

    void visit(LevelBrick node) {
        for (int k = 0; k < 3; ++k) {
            if (node.brick[k] * kBrickSize >= space_.cellsAt(node.level)[k]) return;
        }
        const TimedField& base = levels_[0];
        const bool both = base.fraction > 0 && base.fraction < 1;
        const auto hull = [&](const KeyFrame& frame) { return frame.pyramid().hull(node.level, node.brick); };
        const ValueRange range = base.fraction == 1 ? hull(*base.b) : hull(*base.a);
        if (!holdsIso(both ? rangeInTime(range, hull(*base.b), base.fraction) : widened(range))) return;
        if (isHidden(node)) {
            selection_.leftOut = true;
            return;
        }
        if (sizes_.isCoarseEnough(node)) {
            if (holdsIso(ownRange(node))) selection_.bricks.push_back(node);
            return;
        }
        for (int child = 0; child < 8; ++child) {
            visit({node.level - 1, 2 * node.brick + glm::ivec3(child & 1, child >> 1 & 1, child >> 2)});
        }
    }

    bool isHidden(LevelBrick node) const {
        const int side = kBrickSize << node.level;
        return seen_.planes() > 0 && seen_.fate(node.brick * side, (node.brick + 1) * side) == ClipFate::gone;
    }

    /// Range of the samples of the node's own level: with subsampling those of the coarser levels are among
    /// them, so it bounds what is blended.
    ValueRange ownRange(LevelBrick node) const {
        const TimedField& field = levels_[node.level];
        const auto own = [&](const KeyFrame& frame) { return frame.range(frame.linear(node.brick)); };
        if (field.fraction == 0) return widened(own(*field.a));
        if (field.fraction == 1) return widened(own(*field.b));
        return rangeInTime(own(*field.a), own(*field.b), field.fraction);
    }

    const LevelSpace& space_;
    const SizeField& sizes_;
    const std::vector<TimedField>& levels_;
    const float iso_;
    const ClipTest seen_;
    LevelSelection selection_;
};

/// Hull of the whole field in time.
ValueRange wholeRange(const LevelSpace& space, const TimedField& field) {
    const auto hull = [&](const KeyFrame& frame) { return frame.pyramid().hull(space.top(), glm::ivec3(0)); };
    if (field.fraction == 0) return hull(*field.a);
    if (field.fraction == 1) return hull(*field.b);
    return rangeInTime(hull(*field.a), hull(*field.b), field.fraction);
}

}  // namespace

std::vector<TimedField> fieldsOfLevels(const LevelSpace& space, const TimedField& field) {
    std::vector<TimedField> levels = {field};
    for (int level = 1; level <= space.top(); ++level) {
        levels.push_back({field.a ? field.a->pyramid().level(level) : nullptr,
                          field.b ? field.b->pyramid().level(level) : nullptr, field.fraction});
    }
    return levels;
}

LevelSelection selectBricks(const LevelSpace& space, const SizeField& sizes,
                            const std::vector<TimedField>& levels, float iso,
                            std::span<const glm::dvec4> planes) {
    return Selector(space, sizes, levels, iso, planes).run();
}

std::vector<MeshPart> meshBricks(const LevelFields& fields, const std::vector<LevelBrick>& bricks,
                                 const CellOptions& options, int threads) {
    std::vector<MeshPart> parts((bricks.size() + kBricksPerTask - 1) / kBricksPerTask);
    parallelFor(bricks.size(), kBricksPerTask, threads, [&](std::size_t begin, std::size_t end) {
        const auto mesher = std::make_unique<BrickMesher>(fields, options);
        MeshPart& part = parts[begin / kBricksPerTask];
        part.positions.reserve(kVerticesPerTask);
        part.normals.reserve(kVerticesPerTask);
        part.triangles.reserve(6 * kVerticesPerTask);
        for (std::size_t i = begin; i < end; ++i) mesher->mesh(bricks[i], part);
    });
    return parts;
}

Extraction extractForView(const Lattice& lattice, const TimedField& field, const ExtractOptions& options) {
    const LevelSpace space(lattice);
    Extraction result;
    result.mesh.origin = space.levels[0].origin;
    result.stats.bricks = static_cast<std::size_t>(space.levels[0].bricks.x) * space.levels[0].bricks.y *
                          space.levels[0].bricks.z;
    for (int k = 0; k < 3; ++k) {
        if (space.cells[k] == 0) return result;
    }
    const SizeField sizes(space, *options.view, field, options.iso, options.threads);
    const LevelFields fields{space, sizes, fieldsOfLevels(space, field),
                             options.insideIsBelow ? -1.0f : 1.0f};
    result.stats.range = wholeRange(space, field);
    const LevelSelection selection =
        selectBricks(space, sizes, fields.fields, options.iso, options.view->planes);
    const std::vector<LevelBrick>& bricks = selection.bricks;
    result.stats.touchedBricks = bricks.size();
    result.stats.leftOut = selection.leftOut;

    std::vector<MeshPart> parts = meshBricks(
        fields, bricks, {.iso = options.iso, .gate = options.still ? 0 : kGateInMotion}, options.threads);
    for (const MeshPart& part : parts) result.stats.lostCells += part.lostCells;
    result.mesh = joinParts(parts, result.mesh.origin, options.threads);
    return result;
}

}  // namespace isoglass
