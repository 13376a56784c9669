#pragma once

#include "mesh/surface_mesh.h"
#include "surface/clip.h"
#include "surface/index_space.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

namespace isoglass {

/// Names a point: a vertex of the extracted mesh, a point that a plane cut from an edge, or a lattice sample.
using PointId = std::uint64_t;

/// Where a polygon of a cut polyhedron lies: on the surface, in face 0..5 of its cell, or in the plane
/// `kFirstCapOrigin + i`.
using PolygonOrigin = int;
inline constexpr PolygonOrigin kOnSurface = -1;
inline constexpr PolygonOrigin kFirstCapOrigin = 6;

/// A closed polyhedron. Polygons are counter-clockwise seen from outside.
struct Polyhedron {
    struct Polygon {
        PolygonOrigin origin;
        std::uint32_t first;  ///< in `points`
        std::uint32_t count;
    };
    std::vector<Polygon> polygons;
    std::vector<PointId> points;
    /// A plane met some polygon in more than one line.
    bool alternates = false;

    void clear() {
        alternates = false;
        polygons.clear();
        points.clear();
    }
    std::span<const PointId> pointsOf(const Polygon& polygon) const {
        return std::span(points).subspan(polygon.first, polygon.count);
    }
};

/// All points of a mesh that is being cut. Points are joined by what they are cut from, never by position: a
/// new point is named by its edge (two points) and the plane, so every polygon that shares the edge gets the
/// same one.
class PointTable {
  public:
    /// Both must outlive the table.
    PointTable(const SurfaceMesh& mesh, const IndexSpace& space) : mesh_(mesh), space_(space) {}

    static PointId vertex(std::uint32_t index) { return index; }
    PointId sample(glm::ivec3 lattice) const;

    /// Relative to the mesh's origin; rounded to float but for lattice samples.
    glm::dvec3 position(PointId point) const;
    /// Of a point on the surface.
    glm::vec3 normal(PointId point) const;
    /// The point between `a` and `b`, at signed distances of opposite sign from plane `plane`.
    PointId cut(PointId a, PointId b, double distanceA, double distanceB, int plane);

    /// Mesh vertices and cut points are the ids below.
    std::size_t vertexAndCutCount() const { return mesh_.positions.size() + cutPositions_.size(); }
    static bool isSample(PointId point) { return point >= kFirstSample; }

  private:
    static constexpr PointId kFirstSample = PointId{1} << 40;

    struct CutKey {
        PointId low, high;
        int plane;
        friend bool operator==(const CutKey&, const CutKey&) = default;
    };
    struct CutHash {
        std::size_t operator()(const CutKey& key) const;
    };

    const SurfaceMesh& mesh_;
    const IndexSpace& space_;
    std::vector<glm::vec3> cutPositions_;
    std::vector<glm::vec3> cutNormals_;
    std::unordered_map<CutKey, PointId, CutHash> cuts_;
};

/// Keeps the part of polyhedra on one side of a plane.
class PlaneCutter {
  public:
    /// `plane` is relative to the world, `number` names it in cut points and origins.
    PlaneCutter(PointTable& points, const CutPlane& plane, glm::dvec3 meshOrigin, int number);

    /// Cuts `polyhedron` and closes it with polygons in the plane. The signs of its points alone decide how
    /// it is cut, so the result is closed for any positions. Where signs alternate around a polygon each
    /// run of cut-off points is cut off by itself, so that two polyhedra that share it agree.
    void cut(Polyhedron& polyhedron);

    double distance(PointId point) const;
    /// Of a position relative to the mesh's origin.
    double distance(const glm::dvec3& position) const {
        return glm::dot(glm::dvec3(plane_), position) + plane_.w;
    }

  private:
    void cutPolygon(const Polyhedron& from, const Polyhedron::Polygon& polygon);
    void closeLoops();

    struct Segment {
        PointId from, to;
        bool used;
    };

    PointTable& points_;
    glm::dvec4 plane_;  ///< relative to the mesh's origin
    int number_;
    Polyhedron result_;
    std::vector<Segment> segments_;
    std::vector<double> distances_;
};

}  // namespace isoglass
