#pragma once

#include "surface/extract.h"
#include "volume/lattice.h"

#include <cstddef>

namespace isoglass {

/// What lies inside an iso-surface.
struct EnclosedVolume {
    double volume = 0;             ///< world units cubed: the axes' units multiplied
    double domain = 0;             ///< volume of all cells that have their samples
    std::size_t missingCells = 0;  ///< cells that lack a sample: in neither
};

/// Volume of the part of the domain that is inside, f >= iso (or <= iso with `insideIsBelow`), for the
/// field that is linear in each of a cell's six Kuhn tetrahedra: exact for it but for rounding. Where the
/// surface is open it is closed by the end of the domain and by cells that lack samples.
///
/// Of second order in the step for a smooth field, like the surface. Pure; the same arguments give the
/// same bits for any `options.threads`. Walks all cells of the domain.
EnclosedVolume enclosedVolume(const Lattice& lattice, const TimedField& field, const ExtractOptions& options);

}  // namespace isoglass
