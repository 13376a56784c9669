#pragma once

#include "volume/key_frame.h"
#include "volume/lattice.h"

#include <glm/vec3.hpp>

#include <functional>
#include <memory>
#include <string_view>
#include <vector>

namespace isoglass {

/// A field given by a formula, of position (world units of the lattice) and time.
using AnalyticField = std::function<float(glm::dvec3 position, double time)>;

/// Eight moving Gaussian blobs in [-1,1]^3, smooth; the surfaces at 0.5 are a few percent of the cells.
float blobs(glm::dvec3 position, double time);
/// Radius 1 minus the distance from the origin, growing by 0.3 a unit of time: surface at 0.3 is a
/// sphere of radius 0.7 at time 0.
float growingSphere(glm::dvec3 position, double time);
/// Gyroid of wave number 8, drifting: surface nearly everywhere at 0.
float gyroid(glm::dvec3 position, double time);

/// One key frame of `field` at `time`, dense samples, x fastest.
std::vector<float> sampleField(const Lattice& lattice, const AnalyticField& field, double time);

/// The same as a key frame in memory.
std::shared_ptr<const KeyFrame> makeAnalyticFrame(const Lattice& lattice, const AnalyticField& field,
                                                  double time);

/// The blobs where they are above `floor`, which must be above 0, and `floor` elsewhere: bricks that lie
/// wholly below are constant, so that memory and time follow the blobs and not the lattice. Samples are those
/// of `blobs` but for rounding, because every blob is a product of functions of one axis.
std::shared_ptr<const KeyFrame> makeSparseBlobs(const Lattice& lattice, double time, float floor);

/// `count`^3 samples over [-1,1]^3.
Lattice makeUnitLattice(int count);

}  // namespace isoglass
