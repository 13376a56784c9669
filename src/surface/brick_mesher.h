#pragma once

#include "surface/blended_brick.h"
#include "surface/mesh_part.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <map>
#include <span>
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

/// Makes the surface inside one brick of any level after another: tetrahedral cells, stitched to finer
/// bricks, clipped at the end of the domain. Working memory of one thread.
class BrickMesher {
  public:
    /// `iso` is already multiplied by the fields' sign; `mirrored` turns the triangles.
    BrickMesher(const LevelFields& fields, float iso, bool mirrored)
        : fields_(fields), iso_(iso), mirrored_(mirrored) {}

    void mesh(LevelBrick node, MeshPart& out);

  private:
    /// The field and its channels at a vertex of the brick or in the middle of an edge.
    struct End {
        float value;
        Channels channels;
    };
    /// A polygon on the way to triangles: at most 3 corners of a triangle and 2 crossings more on each of its
    /// sides, which are 9; each of 3 cuts adds one, or a few where the polygon lies in the cutting plane.
    struct Polygon {
        std::array<std::uint32_t, 72> vertices;
        int size = 0;

        void add(std::uint32_t vertex) { vertices[size++] = vertex; }
    };

    void begin(LevelBrick node, MeshPart& out);
    void markInside();
    void meshRow(int x, int y);
    void meshCell(glm::ivec3 cell, int pattern);
    void addTriangle(glm::ivec3 cell, const std::array<std::uint8_t, 3>& edges);
    void addPolygon(const Polygon& polygon, int fanFrom);
    int splitFacesOf(glm::ivec3 cell) const;
    int cutAxesOf(glm::ivec3 cell) const;

    std::uint32_t vertexOn(glm::ivec3 cell, std::uint8_t edge);
    std::uint32_t makeEdgeVertex(glm::ivec3 low, int direction);
    void addSplitSide(glm::ivec3 cell, int splitFaces, std::uint8_t from, std::uint8_t to, Polygon& polygon);
    Polygon cut(const Polygon& polygon, int axis);
    std::uint32_t cutSide(std::uint32_t a, std::uint32_t b, int axis);
    void dropUnused();

    End endAt(glm::ivec3 corner);
    static End middle(const End& a, const End& b);
    std::uint32_t addCrossing(const End& low, const End& high, int level, glm::ivec3 lowVertex, int direction,
                              bool shared);
    std::uint32_t addVertex(glm::vec3 position, glm::vec3 normal, VertexKey key, bool shared,
                            glm::dvec3 index);

    const LevelFields& fields_;
    const float iso_;
    const bool mirrored_;
    BlendedBrick brick_;
    LevelBrick node_;
    MeshPart* out_ = nullptr;
    FinerNeighbours finer_;
    glm::ivec3 cellEnd_;  ///< local cells of the brick that lie at least partly in the domain
    bool cuts_ = false;   ///< the domain ends inside cells of the brick
    std::array<std::uint32_t, kCornersPerSide * kCornersPerSide> inside_;  ///< row x*9 + y, bit z
    std::array<std::uint32_t, kCornersPerSide * kCornersPerSide> valid_;   ///< likewise
    /// Vertex on the edge from a corner in a direction (1..7), kNone where it is not made.
    std::array<std::uint32_t, kBrickCorners * 7> slots_;

    // Only where the domain cuts cells: what a cut has to know of each vertex of the brick.
    std::uint32_t firstVertex_ = 0;
    std::size_t firstTriangle_ = 0;
    std::size_t firstShared_ = 0;
    std::vector<glm::dvec3> indices_;  ///< level-0 index position
    std::vector<VertexKey> keys_;
    std::map<VertexKey, std::uint32_t> cutVertices_;
};

}  // namespace isoglass
