#include "surface/clip_mesh.h"

#include "surface/cell_solid.h"
#include "surface/cell_table.h"
#include "surface/clip_output.h"
#include "surface/solid_cutter.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace isoglass {

namespace {

glm::ivec3 cornerOf(int corner) {
    return {corner & 1, corner >> 1 & 1, corner >> 2};
}

/// Corner pattern of a cell, or -1 where it lacks a sample.
int patternOf(const BrickField& field, glm::ivec3 cell, float iso) {
    int pattern = 0;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::ivec3 at = cell + cornerOf(corner);
        const float value = field.values[BrickField::at(at.x, at.y, at.z)];
        if (std::isnan(value)) return -1;
        pattern |= static_cast<int>(value >= iso) << corner;
    }
    return pattern;
}

/// Walks through the bricks and cells that something is done to.
class MeshClipper {
  public:
    MeshClipper(const IndexSpace& space, const TimedField& field, const ExtractOptions& options,
                const FindRecords& findRecords, const SurfaceMesh& mesh)
        : space_(space),
          field_(field),
          options_(options),
          findRecords_(findRecords),
          sign_(options.insideIsBelow ? -1.0f : 1.0f),
          test_(space, options.clip),
          points_(mesh, space),
          output_(points_, space, options) {
        for (std::size_t i = 0; i < options.clip.size(); ++i)
            cutters_.emplace_back(points_, options.clip[i], space.origin, static_cast<int>(i));
    }

    void run(std::span<const BrickRecord> records, const SurfaceMesh& mesh) {
        const auto* record = records.data();
        const auto* const end = record + records.size();
        glm::ivec3 brick;
        for (brick.z = 0; brick.z < space_.bricks.z; ++brick.z) {
            for (brick.y = 0; brick.y < space_.bricks.y; ++brick.y) {
                for (brick.x = 0; brick.x < space_.bricks.x; ++brick.x) {
                    const bool touched = record != end && record->brick == brick;
                    addBrick(brick, touched ? record : nullptr, mesh);
                    if (touched) ++record;
                }
            }
        }
    }

    void finish(Extraction& extraction) const { output_.finish(extraction); }

  private:
    void addBrick(glm::ivec3 brick, const BrickRecord* record, const SurfaceMesh& mesh) {
        const glm::ivec3 low = brick * kBrickSize;
        const glm::ivec3 cells = glm::min(glm::ivec3(kBrickSize), space_.cells - low);
        if (cells.x <= 0 || cells.y <= 0 || cells.z <= 0) return;
        const ClipFate fate = test_.fate(low, low + cells);
        if (fate == ClipFate::gone) return;
        if (fate == ClipFate::kept && !(options_.closed && meetsEnd(low, low + cells))) {
            if (record) output_.keepTriangles(mesh, record->firstTriangle, record->triangleCount);
            return;
        }
        if (!record && isOutside(brick)) return;
        gatherBrick(space_, field_, brick, sign_, scratch_, gathered_);
        const EdgeVertices vertices(findRecords_(brick));
        glm::ivec3 cell;
        for (cell.x = 0; cell.x < cells.x; ++cell.x) {
            for (cell.y = 0; cell.y < cells.y; ++cell.y) {
                for (cell.z = 0; cell.z < cells.z; ++cell.z) addCell(low, cell, vertices);
            }
        }
    }

    bool meetsEnd(glm::ivec3 low, glm::ivec3 high) const {
        for (int k = 0; k < 3; ++k) {
            if (!space_.periodic[k] && (low[k] == 0 || high[k] == space_.cells[k])) return true;
        }
        return false;
    }

    /// Whether a brick that the surface does not touch has nothing inside by its key frames' ranges alone.
    bool isOutside(glm::ivec3 brick) const {
        const auto outside = [&](const KeyFrame& frame) {
            const ValueRange range = frame.range(frame.linear(brick));
            if (!(range.min <= range.max)) return true;
            return options_.insideIsBelow ? range.min > options_.iso : range.max < options_.iso;
        };
        if (field_.fraction == 0) return outside(*field_.a);
        if (field_.fraction == 1) return outside(*field_.b);
        return outside(*field_.a) && outside(*field_.b);
    }

    void addCell(glm::ivec3 low, glm::ivec3 cell, const EdgeVertices& vertices) {
        const glm::ivec3 at = low + cell;
        const int pattern = patternOf(gathered_, cell, sign_ * options_.iso);
        if (pattern <= 0) return;
        cutting_.clear();
        for (std::size_t i = 0; i < cutters_.size(); ++i) {
            const ClipFate fate = test_.fate(i, at, at + 1);
            if (fate == ClipFate::gone) return;
            if (fate == ClipFate::cut) cutting_.push_back(i);
        }
        if (pattern == 255 && cutting_.empty() && !(options_.closed && meetsEnd(at, at + 1))) return;
        makePolyhedron(pattern, at, cell, vertices);
        for (const std::size_t i : cutting_) cutters_[i].cut(polyhedron_);
        output_.add(polyhedron_, at, pattern == 255);
    }

    void makePolyhedron(int pattern, glm::ivec3 at, glm::ivec3 cell, const EdgeVertices& vertices) {
        polyhedron_.clear();
        for (const CellSolid::Polygon& polygon : cellSolids()[pattern].polygons) {
            polyhedron_.polygons.push_back({polygon.face,
                                            static_cast<std::uint32_t>(polyhedron_.points.size()),
                                            static_cast<std::uint32_t>(polygon.points.size())});
            for (const std::uint8_t point : polygon.points) {
                if (point < kFirstCrossing) {
                    polyhedron_.points.push_back(points_.sample(at + cornerOf(point)));
                } else {
                    const int edge = point == kBodyCrossing ? kBodyEdge : point - kFirstCrossing;
                    polyhedron_.points.push_back(PointTable::vertex(vertices.at(cell, edge)));
                }
            }
        }
    }

    const IndexSpace& space_;
    const TimedField& field_;
    const ExtractOptions& options_;
    const FindRecords& findRecords_;
    const float sign_;
    ClipTest test_;
    PointTable points_;
    ClipOutput output_;
    std::vector<PlaneCutter> cutters_;
    std::vector<std::size_t> cutting_;
    Polyhedron polyhedron_;
    BrickField gathered_;
    BrickField scratch_;
};

}  // namespace

ClipTest::ClipTest(const IndexSpace& space, std::span<const CutPlane> planes) : space_(space) {
    for (const CutPlane& plane : planes) add(plane.plane);
}

ClipTest::ClipTest(const IndexSpace& space, std::span<const glm::dvec4> planes) : space_(space) {
    for (const glm::dvec4& plane : planes) add(plane);
}

void ClipTest::add(const glm::dvec4& plane) {
    double reach = std::abs(plane.w);
    for (int k = 0; k < 3; ++k) {
        double largest = std::abs(space_.origin[k]);
        for (const double coordinate : space_.axes[k].coordinate)
            largest = std::max(largest, std::abs(coordinate));
        reach += std::abs(plane[k]) * largest;
    }
    // A vertex lies within half an ulp of float of where its cell has it, in each coordinate; eight
    // times that also covers the double arithmetic of both sides.
    const double slack = 4 * std::numeric_limits<float>::epsilon() * reach;
    planes_.push_back({{glm::dvec3(plane), CutPlane{plane}.distance(space_.origin)}, slack});
}

ClipFate ClipTest::fate(std::size_t plane, glm::ivec3 low, glm::ivec3 high) const {
    const glm::dvec4& relative = planes_[plane].relative;
    double smallest = relative.w;
    double largest = relative.w;
    for (int k = 0; k < 3; ++k) {
        const auto& table = space_.axes[k].coordinate;
        const double a = relative[k] * table[std::clamp(low[k], 0, space_.cells[k])];
        const double b = relative[k] * table[std::clamp(high[k], 0, space_.cells[k])];
        smallest += std::min(a, b);
        largest += std::max(a, b);
    }
    if (largest < -planes_[plane].slack) return ClipFate::gone;
    return smallest > planes_[plane].slack ? ClipFate::kept : ClipFate::cut;
}

ClipFate ClipTest::fate(glm::ivec3 low, glm::ivec3 high) const {
    ClipFate all = ClipFate::kept;
    for (std::size_t i = 0; i < planes_.size(); ++i) {
        const ClipFate one = fate(i, low, high);
        if (one == ClipFate::gone) return one;
        if (one == ClipFate::cut) all = one;
    }
    return all;
}

bool ClipTest::skips(glm::ivec3 brick) const {
    return !planes_.empty() && fate((brick - 1) * kBrickSize, (brick + 1) * kBrickSize) == ClipFate::gone;
}

bool ClipTest::hides(glm::ivec3 brick) const {
    return !planes_.empty() && fate(brick * kBrickSize, (brick + 1) * kBrickSize) == ClipFate::gone;
}

void clipMesh(const IndexSpace& space, const TimedField& field, const ExtractOptions& options,
              std::span<const BrickRecord> records, const FindRecords& findRecords, Extraction& extraction) {
    const SurfaceMesh whole = std::move(extraction.mesh);
    MeshClipper clipper(space, field, options, findRecords, whole);
    clipper.run(records, whole);
    clipper.finish(extraction);
}

}  // namespace isoglass
