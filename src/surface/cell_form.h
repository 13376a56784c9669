#pragma once

#include <array>

namespace isoglass {

/// Ratio of the allowed size to the cells of a level at which the next level begins to blend in; it has taken
/// over at 2. From here on cells are tetrahedral.
inline constexpr float kBlendFrom = 1.9f;

/// How cells are cut.
enum class CellForm {
    sliding,      ///< compact wherever no levels blend or touch, with a smooth change between the forms
    tetrahedral,  ///< tetrahedra everywhere: three times the triangles, for comparison
};

/// What cells need to know of the wanted surface.
struct CellOptions {
    float iso = 0;  ///< of the field before it is multiplied by its sign
    CellForm form = CellForm::sliding;
    /// Lets compact cells become tetrahedral where a sample comes as near to the iso-value as this share of
    /// the largest difference in its cell, so that nothing jumps when the iso-value passes the sample in
    /// time. 0 keeps them compact; 0.03 to 0.1 takes 0.38 to 0.46 times the triangles of tetrahedra, not
    /// 0.33.
    float gate = 0;
};

/// Between compact cells (weight 0), whose vertices lie on axis edges, and tetrahedral cells (weight 1),
/// which are exact where levels blend and touch: the vertices that only the latter have slide to their
/// places.
///
/// A weight belongs to a lattice vertex and depends on the ratio of its allowed size to the cells of its
/// level alone. It is 1 where the level begins, so that all cells that touch smaller ones are tetrahedral;
/// falls to 0; and is 1 again before the next level blends in. Level 0 begins with 0, and the top level stays
/// with it.
struct FormRamp {
    /// `growth`: how much the ratio grows over the diagonal of a brick at most.
    FormRamp(int level, int top, float growth);

    float weight(float sizeRatio) const;
    /// Bounds of the weights for ratios in [low, high]: whether all are 0, or all are 1.
    bool isCompact(float low, float high) const;
    bool isTetrahedral(float low, float high) const;

  private:
    float fallFrom_, fallTo_;  ///< 1 up to the first, 0 from the second on
    float riseFrom_, riseTo_;
};

/// Where the other two corners of a face, with values `a` and `c` relative to the iso-value, lie on one side:
/// rises to 1 as the end of the diagonal that shares it, of `diagonal` = its two ends, comes to the
/// iso-value, where the compact patch would change its topology. Else 0.
float faceGate(const std::array<float, 2>& diagonal, const std::array<float, 2>& others);

/// Rises to 1 as one of the 8 values relative to the iso-value comes within `width` times the largest of them
/// to 0: the fan around the body vertex would change.
float bodyGate(const std::array<float, 8>& values, float width);

}  // namespace isoglass
