#pragma once

#include "surface/extract.h"
#include "surface/index_space.h"
#include "surface/solid_cutter.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

namespace isoglass {

/// Collects what clipping keeps: triangles of the surface and of the caps, by the names of their points.
class ClipOutput {
  public:
    /// All must outlive the output.
    ClipOutput(const PointTable& points, const IndexSpace& space, const ExtractOptions& options);

    /// Takes triangles of the extracted mesh as they are.
    void keepTriangles(const SurfaceMesh& mesh, std::size_t first, std::size_t count);
    /// Takes the polygons of a cell's polyhedron. `whole` says that it was the whole cell before it was cut.
    void add(const Polyhedron& polyhedron, glm::ivec3 cell, bool whole);
    /// Numbers the points that are used and writes mesh and caps.
    void finish(Extraction& extraction) const;

  private:
    struct CapVertex {
        PointId point;  ///< kNoPoint for the middle of a polygon
        glm::vec3 position;
        PolygonOrigin origin;
    };
    struct CapKey {
        PointId point;
        PolygonOrigin origin;
        friend bool operator==(const CapKey&, const CapKey&) = default;
    };
    struct CapHash {
        std::size_t operator()(const CapKey& key) const {
            return static_cast<std::size_t>((key.point * 0x9e3779b97f4a7c15u) >> 20) +
                   static_cast<std::size_t>(key.origin);
        }
    };
    static constexpr PointId kNoPoint = ~PointId{0};

    bool isCap(PolygonOrigin origin, glm::ivec3 cell) const;
    void addTriangle(PointId a, PointId b, PointId c);
    void addCap(std::span<const PointId> points, PolygonOrigin origin, bool fan);
    std::uint32_t capVertex(PointId point, PolygonOrigin origin);
    std::uint32_t middleVertex(std::span<const PointId> points, PolygonOrigin origin);
    glm::vec3 capNormal(PolygonOrigin origin) const;
    void writeMesh(const std::vector<std::uint32_t>& places, SurfaceMesh& mesh) const;
    void writeCaps(const std::vector<std::uint32_t>& places, Extraction& extraction) const;

    const PointTable& points_;
    const IndexSpace& space_;
    const ExtractOptions& options_;
    std::vector<PointId> triangles_;  ///< three a triangle
    std::vector<CapVertex> capVertices_;
    std::vector<std::uint32_t> capTriangles_;
    std::unordered_map<CapKey, std::uint32_t, CapHash> capIndex_;
};

}  // namespace isoglass
