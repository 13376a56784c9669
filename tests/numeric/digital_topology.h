#pragma once

#include <glm/vec3.hpp>

#include <cstddef>
#include <span>

namespace isoglass::numeric {

/// What the signs of the samples alone say of the surface, by digital topology on the Kuhn lattice, where a
/// sample has 14 neighbours (the seven directions {0,1}^3 \ 0 and their opposites).
struct DigitalTopology {
    /// No sample on the domain's end is inside, none is missing: the surface is closed.
    bool closed = false;
    std::size_t insideComponents = 0;
    std::size_t outsideComponents = 0;
    /// The region f >= iso retracts onto the simplices whose corners are all inside: vertices - edges +
    /// triangles - tetrahedra.
    std::ptrdiff_t insideEulerNumber = 0;

    /// Each surface component separates one inside from one outside component, and in a box, which has no
    /// tunnels, these contacts form a tree. Means something where `closed`.
    std::size_t surfaceComponents = 0;
    /// The boundary of a 3-manifold has twice its Euler number.
    std::ptrdiff_t surfaceEulerNumber = 0;
};

/// `samples` are dense, x fastest. Independent of the engine: no cells, no table, no crossings.
DigitalTopology digitalTopology(glm::ivec3 dims, std::span<const float> samples, float iso, bool below);

}  // namespace isoglass::numeric
