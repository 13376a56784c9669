#pragma once

#include "volume/lattice.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace isoglass {

/// Where the samples of a foreign array lie: sample (i,j,k), counted along the axes of the array, is at
/// origin + i * steps[0] + j * steps[1] + k * steps[2].
struct AffinePlace {
    glm::dvec3 origin{0};
    std::array<glm::dvec3, 3> steps{glm::dvec3{1, 0, 0}, glm::dvec3{0, 1, 0}, glm::dvec3{0, 0, 1}};
};

/// An array brought to axis tables.
struct OrientedAxes {
    Lattice lattice;
    std::array<std::size_t, 3> axes{0, 1, 2};  ///< which axis of the array is x, y, z
    std::vector<std::string> notes;            ///< what was done, a sentence each
};

/// Gives every axis of the array the world axis that it is nearest to, keeping handedness: nothing is
/// flipped, a step against its world axis makes a descending table. Axis tables cannot hold a rotation: where
/// the far corner would move by more than a hundredth of a voxel the tables keep the lengths of the steps and
/// the place of the first sample, and a note gives the `place` of a scene that turns the volume to where the
/// file says it is. Throws Error where the steps are not at right angles, too short or not finite.
OrientedAxes orient(const AffinePlace& place, const std::array<std::uint64_t, 3>& lengths,
                    const std::string& file);

/// The same world seen with x and y pointing the other way: turns left-posterior-superior coordinates, in
/// which ITK works, into right-anterior-superior ones, in which NIfTI does.
AffinePlace turnedAboutZ(const AffinePlace& place);

}  // namespace isoglass
