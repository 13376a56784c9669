#pragma once

#include "surface/brick_surface.h"
#include "surface/extract.h"
#include "surface/index_space.h"

#include <glm/vec3.hpp>

#include <array>
#include <functional>
#include <span>

namespace isoglass {

/// What the planes of an extraction do to a box of cells.
enum class ClipFate { kept, cut, gone };

/// Decides the fate of whole boxes, with room for the rounding of mesh positions to float.
class ClipTest {
  public:
    ClipTest(const IndexSpace& space, std::span<const CutPlane> planes);
    /// By what a view sees: `View::planes`.
    ClipTest(const IndexSpace& space, std::span<const glm::dvec4> planes);

    /// Of the cells from `low` up to `high` (lattice samples, both ends belong to the box; clamped to the
    /// domain). `gone` where a single plane cuts all of it off.
    ClipFate fate(glm::ivec3 low, glm::ivec3 high) const;
    /// Of one plane alone.
    ClipFate fate(std::size_t plane, glm::ivec3 low, glm::ivec3 high) const;

    /// Whether a brick need not be extracted: neither its own cells nor those of the bricks before it,
    /// which use its vertices, keep anything.
    bool skips(glm::ivec3 brick) const;
    /// Whether a brick's own cells keep nothing.
    bool hides(glm::ivec3 brick) const;

    std::size_t planes() const { return planes_.size(); }

  private:
    void add(const glm::dvec4& plane);

    struct Plane {
        glm::dvec4 relative;  ///< to the mesh's origin
        double slack;
    };

    const IndexSpace& space_;
    std::vector<Plane> planes_;
};

/// The records around a brick, as `writeTriangles` wants them.
using FindRecords = std::function<std::array<const BrickRecord*, 8>(glm::ivec3 brick)>;

/// Cuts a mesh that was extracted with the same arguments, and caps what is inside on the cuts, by
/// `options.clip` and `options.closed`. `records` are in the order of the mesh's triangles.
///
/// In every cell that a plane meets, the inside part is taken as a closed polyhedron (`CellSolid`), cut, and
/// its polygons are handed out: those on the surface to the mesh, those in planes (and faces at the domain's
/// end) to the caps. Cells share the points of their common faces by name, so mesh and caps close by
/// identity.
void clipMesh(const IndexSpace& space, const TimedField& field, const ExtractOptions& options,
              std::span<const BrickRecord> records, const FindRecords& findRecords, Extraction& extraction);

}  // namespace isoglass
