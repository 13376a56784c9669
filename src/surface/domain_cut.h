#pragma once

#include "surface/brick_vertices.h"
#include "surface/mesh_part.h"

#include <glm/vec3.hpp>

#include <map>

namespace isoglass {

/// Cuts the polygons of one brick at the end of the domain, where that lies inside its cells. Working memory
/// of one thread.
class DomainCut {
  public:
    /// The lattice ends at level-0 index `end`. The vertices must keep their places.
    void begin(glm::ivec3 end, BrickVertices& vertices, MeshPart& out);

    /// Keeps what lies at indices up to the end along `axis` (Sutherland and Hodgman 1974).
    VertexPolygon cut(const VertexPolygon& polygon, int axis);
    /// Removes the vertices of the brick that no triangle needs.
    void dropUnused();

  private:
    std::uint32_t cutSide(std::uint32_t a, std::uint32_t b, int axis);

    glm::ivec3 end_{0};
    BrickVertices* vertices_ = nullptr;
    MeshPart* out_ = nullptr;
    std::size_t firstTriangle_ = 0;
    std::size_t firstShared_ = 0;
    std::map<VertexKey, std::uint32_t> cuts_;
};

}  // namespace isoglass
