#pragma once

#include "surface/blended_brick.h"
#include "surface/cell_form.h"
#include "surface/extract.h"
#include "surface/level_space.h"
#include "surface/mesh_part.h"
#include "surface/size_field.h"

#include <span>
#include <vector>

namespace isoglass {

// The steps of extraction with levels of detail, in their order. Pure.

/// The key frames of every level, level 0 first. Builds pyramids that are not there yet.
std::vector<TimedField> fieldsOfLevels(const LevelSpace& space, const TimedField& field);

struct LevelSelection {
    std::vector<LevelBrick> bricks;
    bool leftOut = false;  ///< see ExtractStats
};

/// The bricks, of whatever level, that the surface seen from a view consists of, in an order that depends on
/// nothing but the arguments: each as coarse as its sizes allow, those left out that the surface does not
/// touch or that lie behind one of `planes` (`View::planes`).
LevelSelection selectBricks(const LevelSpace& space, const SizeField& sizes,
                            const std::vector<TimedField>& levels, float iso,
                            std::span<const glm::dvec4> planes = {});

/// Meshes bricks, some of them to a part, in their order.
std::vector<MeshPart> meshBricks(const LevelFields& fields, const std::vector<LevelBrick>& bricks,
                                 const CellOptions& options, int threads);

/// `extractSurface` with the detail that `options.view` asks for, which must want some.
Extraction extractForView(const Lattice& lattice, const TimedField& field, const ExtractOptions& options);

}  // namespace isoglass
