#pragma once

#include "surface/blended_brick.h"
#include "surface/brick_vertices.h"
#include "surface/cell_form.h"
#include "surface/cell_table.h"
#include "surface/domain_cut.h"
#include "surface/mesh_part.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>

namespace isoglass {

/// Makes the surface inside one brick of any level after another: compact and tetrahedral cells and what lies
/// between them, stitched to finer bricks, cut at the end of the domain. Working memory of one thread.
class BrickMesher {
  public:
    BrickMesher(const LevelFields& fields, const CellOptions& options);

    void mesh(LevelBrick node, MeshPart& out);

  private:
    enum class Form { compact, tetrahedral, sliding };
    using CellRows = std::array<int, 4>;

    void begin(LevelBrick node, MeshPart& out);
    Form chooseForm();
    void markInside();
    void meshRow(int x, int y);
    void countLost(const CellRows& rows, std::uint32_t cells);
    void meshCell(glm::ivec3 cell, int pattern);
    void meshTetrahedra(glm::ivec3 cell, const CellCase& cellCase);
    void meshSliding(glm::ivec3 cell, const CellCase& cellCase);
    std::array<float, 8> cornerValues(glm::ivec3 cell) const;
    float faceWeight(std::uint8_t diagonal, const std::array<float, 8>& weights,
                     const std::array<float, 8>& values) const;

    void addTriangle(glm::ivec3 cell, const std::array<std::uint8_t, 3>& edges,
                     const std::array<std::uint32_t, 3>& vertices);
    void addSplitSide(glm::ivec3 cell, int splitFaces, std::uint8_t from, std::uint8_t to,
                      VertexPolygon& polygon);
    void addFan(const VertexPolygon& polygon, int fanFrom);
    int splitFacesOf(glm::ivec3 cell) const;
    int cutAxesOf(glm::ivec3 cell) const;

    const LevelFields& fields_;
    const CellOptions options_;
    const float iso_;  ///< multiplied by the fields' sign, like all values
    BlendedBrick brick_;
    FinerNeighbours finer_;
    BrickVertices vertices_;
    DomainCut domainCut_;
    LevelBrick node_;
    MeshPart* out_ = nullptr;
    Form form_ = Form::compact;
    glm::ivec3 cellEnd_{0};  ///< local cells of the brick that lie at least partly in the domain
    bool cuts_ = false;      ///< the domain ends inside cells of the brick
    std::array<std::uint32_t, kCornersPerSide * kCornersPerSide> inside_;  ///< row x*9 + y, bit z
    std::array<std::uint32_t, kCornersPerSide * kCornersPerSide> valid_;   ///< likewise
    std::array<float, kBrickCorners> weights_;  ///< of the form, where it is sliding
};

}  // namespace isoglass
