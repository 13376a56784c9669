#pragma once

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace isoglass {

/// A triangle mesh of one iso-surface, as structure of arrays. Those of files need not be manifolds, nor
/// wound alike.
///
/// An oriented 2-manifold by vertex index, with boundary only where the domain ends, samples are missing
/// or a clip cuts. Winding is counter-clockwise seen from outside (where the field is beyond the
/// iso-value on the low side, or on the high side for a surface whose inside is below). Zero-area
/// triangles, which occur where samples equal the iso-value, stay in the graph with finite normals.
struct SurfaceMesh {
    /// World position of the origin that `positions` are relative to, in the series' axis units.
    glm::dvec3 origin{0};
    /// One a vertex, world units, relative to `origin`. Always finite.
    std::vector<glm::vec3> positions;
    /// One a vertex: minus the field's gradient in world space (towards outside), *not* normalised, so
    /// that it interpolates without popping; normalise per fragment. Finite and never zero.
    std::vector<glm::vec3> normals;
    /// Empty, or one a vertex: the value that colours it; NaN where there is none.
    std::vector<float> colorValues{};
    /// Empty, or one a vertex: how far the surface would move along its normal until the end of the time
    /// between the key frames' times, if it went on as it moves now (see motion.h). Finite.
    std::vector<glm::vec3> velocities{};
    /// Three vertex indices a triangle.
    std::vector<std::uint32_t> triangles;

    std::size_t vertexCount() const { return positions.size(); }
    std::size_t triangleCount() const { return triangles.size() / 3; }
    bool empty() const { return triangles.empty(); }
    /// Bytes of the arrays.
    std::size_t bytes() const;
};

}  // namespace isoglass
