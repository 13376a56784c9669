#pragma once

#include "scene/scene.h"

#include <string>
#include <string_view>
#include <vector>

namespace isoglass {

/// The passes a frame can have. Each runs for all surfaces of all volumes before the next one begins.
enum class PassKind {
    opaque,                  ///< background and opaque surfaces: color and the depth that stays
    attenuation,             ///< product of (1 - opacity) over all semi-transparent fragments
    emission,                ///< sum of opacity * color over the semi-transparent fragments
    attenuationAndEmission,  ///< both sums in one walk over the geometry, for the 3-pass method
    backFaceDepth,           ///< nearest of opaque depth and semi-transparent back faces
    resolve,                 ///< background * transmittance + emission, exposure, sRGB
};

/// The name that people read, e.g. "back-face depth".
std::string_view passName(PassKind kind);

/// What is known of a frame before it is drawn.
struct PlanInput {
    int opaqueSurfaces = 0;           ///< visible ones
    int semiTransparentSurfaces = 0;  ///< visible ones: opacity above 0 and below 1
    TransparencyMethod method = TransparencyMethod::automatic;
    /// Draws attenuation and emission of the 3-pass method one after the other instead of together.
    bool separatePasses = false;
};

struct PlannedPass {
    PassKind kind;
    std::string reason;  ///< why it runs, or why it is left out; a clause without a full stop
};

struct FramePlan {
    /// The method that `automatic` stands for here; without semi-transparent surfaces it has no effect.
    TransparencyMethod method;
    std::vector<PlannedPass> passes;   ///< in the order in which they run
    std::vector<PlannedPass> leftOut;  ///< every other kind, once

    bool runs(PassKind kind) const;
};

/// Decides the passes of a frame. Pure. Composition is that of S. Roettger, "Volume rendering in libMini",
/// section 4: 3-pass B prod(1-a_i) + sum e_i, 4-pass with the emission cut at the nearest back face.
/// `automatic` takes 4-pass.
FramePlan planFrame(const PlanInput& input);

}  // namespace isoglass
