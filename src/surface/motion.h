#pragma once

#include "mesh/surface_mesh.h"
#include "surface/extract.h"
#include "volume/lattice.h"

#include <glm/vec3.hpp>

#include <vector>

namespace isoglass {

/// How a surface moves between the key frames of `field`: with s the fraction and G the gradient, its normal
/// velocity is -(df/ds) G / |G|^2, for each vertex of a mesh of that moment. df/ds is the difference of the
/// key frames, linear between samples; it is that of the full resolution, also where cells are coarser. 0
/// where a sample is missing. Empty at key frames (no second one is known there) and for lattices with
/// heights. Pure.
std::vector<glm::vec3> normalVelocities(const SurfaceMesh& mesh, const Lattice& lattice,
                                        const TimedField& field, const ExtractOptions& options);

/// How far a vertex moves while the fraction grows by `motion`: as its velocity says, at most `limit` far.
/// The vertex shaders compute the same.
glm::vec3 displacement(const glm::vec3& velocity, float motion, float limit);

/// The most that a vertex is moved: the smallest step of the lattice. Farther away the field is another one.
double motionLimit(const Lattice& lattice);

}  // namespace isoglass
