#pragma once

#include "surface/blended_brick.h"
#include "surface/mesh_part.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

namespace isoglass {

/// The sides of a brick on which the surface is made of smaller cells.
struct FinerNeighbours {
    /// By touch: 9 (x + 1) + 3 (y + 1) + z + 1, each -1, 0 or 1: whether one of the neighbours that share a
    /// piece of the brick's boundary with that touch is finer. Touch (1,0,0) is the face x = 8, touch
    /// (1,1,0) the edge line x = y = 8, which the neighbours at (1,0,0), (0,1,0) and (1,1,0) share.
    std::array<bool, 27> touch{};
    bool any = false;

    bool face(int axis, int side) const {
        constexpr std::array<int, 3> kStep = {9, 3, 1};
        return touch[13 + kStep[axis] * side];
    }
};

FinerNeighbours finerNeighbours(const LevelSpace& space, const SizeField& sizes, LevelBrick node);

/// Offset of a cell's corner: bits x, y, z.
constexpr glm::ivec3 cornerOffset(int corner) {
    return {corner & 1, corner >> 1 & 1, corner >> 2};
}

/// A polygon on the way to triangles: at most 3 corners of a triangle and 2 crossings more on each of its
/// sides, which are 9; each of 3 cuts adds one, or a few where the polygon lies in the cutting plane.
struct VertexPolygon {
    std::array<std::uint32_t, 72> vertices;
    int size = 0;

    void add(std::uint32_t vertex) { vertices[size++] = vertex; }
};

/// Makes the vertices of one brick, each once, and appends them to a part. Working memory of one thread.
class BrickVertices {
  public:
    /// What cuts at the domain's end have to know of a vertex.
    struct Place {
        glm::dvec3 index;  ///< level-0 index position
        VertexKey key;
    };

    /// The brick's mesh goes to `out`. `keepPlaces` where the domain ends inside its cells.
    void begin(BlendedBrick& brick, const FinerNeighbours& finer, float iso, bool keepPlaces, MeshPart& out);

    const FinerNeighbours& finer() const { return *finer_; }
    /// First vertex of this brick in the part.
    std::uint32_t first() const { return first_; }

    /// The crossing of a cell's edge with the surface. An edge that smaller cells share is split: the half
    /// that is crossed carries it.
    std::uint32_t onEdge(glm::ivec3 cell, std::uint8_t edge);
    /// The vertex of a crossed face diagonal between the axis crossings p and q, which slides with `weight`
    /// in (0, 1] from where their chord meets the diagonal to its crossing.
    std::uint32_t onDiagonal(glm::ivec3 cell, std::uint8_t diagonal, std::uint8_t p, std::uint8_t q,
                             float weight);
    /// The vertex of the body diagonal, which slides with `weight` in (0, 1] from the axis crossing `apex`.
    std::uint32_t onBody(glm::ivec3 cell, std::uint8_t apex, float weight);

    /// Adds the crossings with the three inner edges of a face triangle that smaller cells split, in their
    /// order from the crossing of edge (a, u) to that of (a, w). The signs alone give the order.
    void addSplitSide(glm::ivec3 a, glm::ivec3 u, glm::ivec3 w, VertexPolygon& polygon);

    const Place& place(std::uint32_t vertex) const { return places_[vertex - first_]; }
    /// `place` only matters where places are kept.
    std::uint32_t add(glm::vec3 position, glm::vec3 normal, const Place& place, bool shared);

  private:
    static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

    /// The field and its channels at a vertex of the brick or in the middle of an edge.
    struct End {
        float value;
        Channels channels;
    };
    /// A vertex before it is added.
    struct Made {
        glm::dvec3 position;
        glm::vec3 normal;
        Place place;
    };

    std::uint32_t& slot(glm::ivec3 cell, std::uint8_t edge);
    double parameter(glm::ivec3 low, int direction) const;
    End endAt(glm::ivec3 corner);
    static End middle(const End& a, const End& b);
    Made crossing(const End& low, const End& high, int level, glm::ivec3 lowVertex, int direction) const;
    Made slid(const Made& from, const Made& to, double weight) const;
    Made madeAt(std::uint32_t vertex) const;
    std::uint32_t add(const Made& made, bool shared);
    int touchOf(glm::ivec3 low, int direction) const;

    BlendedBrick* brick_ = nullptr;
    const FinerNeighbours* finer_ = nullptr;
    MeshPart* out_ = nullptr;
    float iso_ = 0;
    bool keepPlaces_ = false;
    std::uint32_t first_ = 0;
    /// Vertex on the edge from a corner in a direction (1..7), kNone where it is not made.
    std::array<std::uint32_t, kBrickCorners * 7> slots_;
    std::vector<Place> places_;
};

}  // namespace isoglass
