#pragma once

#include "surface/brick_field.h"
#include "surface/brick_surface.h"
#include "surface/index_space.h"

#include <glm/vec3.hpp>

namespace isoglass {

/// Makes the vertices of one gathered brick whose samples lie at heights of their own (`Lattice::heights`).
///
/// World is (x[i], y[j], Z(i,j,k)), so a lattice edge is a straight line in world and a vertex on it blends
/// the heights of its ends like every other channel. The gradient is that of the field along the lattice's
/// lines, times the inverse Jacobian of this mapping: f_z by differences along the column, on its own uneven
/// steps; f_x = f_i - f_z Z_i and f_y alike, with the same differences of the field and of the heights. It is
/// exact, but for rounding, where the field is linear in world, whatever the heights are.
class HeightVertexMaker {
  public:
    /// `heights` are gathered like `field`; where a sample of the field is valid, so is its height.
    HeightVertexMaker(const IndexSpace& space, glm::ivec3 brick, const BrickField& field,
                      const BrickField& heights, float iso)
        : space_(space), first_(brick * kBrickSize), field_(field), heights_(heights), iso_(iso) {}

    /// As VertexMaker::make.
    void make(glm::ivec3 low, int direction, VertexBuffer& out) const;

  private:
    glm::vec3 gradient(glm::ivec3 sample) const;
    glm::dvec3 world(glm::ivec3 sample) const;

    const IndexSpace& space_;
    glm::ivec3 first_;
    const BrickField& field_;
    const BrickField& heights_;
    float iso_;
};

}  // namespace isoglass
