#pragma once

#include "scene/scene.h"

#include <string>
#include <string_view>
#include <vector>

namespace isoglass {

/// The passes a frame can have. Each runs for all surfaces of all volumes before the next one begins.
enum class PassKind {
    opaque,                  ///< background and opaque surfaces: color and the depth that stays
    layers,                  ///< an iso-surface's layers by rays through the samples, over what is opaque
    shadedVolume,            ///< a volume's light and absorption by rays through the samples, likewise
    firstSurface,            ///< illustrative: normal and distance of what is seen first
    secondSurface,           ///< illustrative: the same of what is seen behind that
    secondaryGeometry,       ///< illustrative: color and brightness of what stays visible behind both
    illustration,            ///< illustrative: lines and hatching, from what the three passes found
    backFaceDepth,           ///< nearest of opaque depth and semi-transparent back faces
    blending,                ///< semi-transparent fragments over each other in the order of the draws
    attenuationAndEmission,  ///< product of (1 - opacity) and sum of opacity * color in one walk
    integerSums,             ///< the same as integer sums, whose bits no order changes
    peeledLayer,             ///< the nearest fragments behind the layer before
    layerBlend,              ///< puts a peeled layer behind those before it
    fragmentLists,           ///< every semi-transparent fragment, in a list for each pixel
    resolve,                 ///< joins what is behind and what is in front; exposure, sRGB
    accumulation,            ///< the same without exposure and sRGB, added to the linear image
    presentation,            ///< linear image to exposure and sRGB
};
inline constexpr int kPassKindCount = 17;

/// The name that people read, e.g. "back-face depth".
std::string_view passName(PassKind kind);

/// What is known of a frame before it is drawn.
struct PlanInput {
    int opaqueSurfaces = 0;           ///< visible ones
    int semiTransparentSurfaces = 0;  ///< visible ones: opacity above 0 and below 1
    bool layerStyle = false;          ///< a volume is shown in layers
    bool shadedVolume = false;        ///< a volume is shown as a medium
    bool illustrative = false;        ///< all surfaces are drawn as lines; the counts above are then 0
    int primarySurfaces = 0;          ///< visible ones, then
    int secondarySurfaces = 0;        ///< likewise
    bool betweenKeyFrames = false;    ///< and its time, in either way, lies between two key frames
    TransparencyMethod method = TransparencyMethod::automatic;
    int layers = 4;             ///< of the method peel, at least 1
    bool reproducible = false;  ///< the same bits for any order of draws and triangles
    bool exactWanted = false;   ///< `automatic` takes exact
    /// Proved for any view: no ray meets two semi-transparent fragments.
    bool overlapImpossible = false;
    int samples = 1;          ///< a pixel, 1 to kMostSamples
    bool keepLinear = false;  ///< the linear image is asked for as well
    bool unchanged = false;   ///< the last picture shows this very frame
};

struct PlannedPass {
    PassKind kind;
    std::string reason;  ///< why it runs, or why it is left out; a clause without a full stop
    int layer = 0;       ///< of peeledLayer and layerBlend, from 0
};

/// The name of the pass, with the number of its layer, from 1, where it has one.
std::string passLabel(const PlannedPass& pass);

struct FramePlan {
    /// What `automatic` stands for here; without semi-transparent surfaces it has no effect.
    TransparencyMethod method = TransparencyMethod::automatic;
    std::string methodReason;          ///< why it is this method
    bool reproducible = false;         ///< sums are integers, peeled layers come from lists
    std::vector<PlannedPass> passes;   ///< in the order in which they run; empty: the last picture stays
    std::vector<PlannedPass> leftOut;  ///< every other kind, once
    /// Samples along each side of a pixel, and pictures with shifted samples that are averaged. All passes
    /// but the presentation run for each of these.
    int supersample = 1;
    int subframes = 1;

    bool runs(PassKind kind) const;
};

/// Decides the passes of a frame. Pure. Composition is that of S. Roettger, "Volume rendering in libMini",
/// section 4: 3-pass B prod(1-a_i) + sum e_i, 4-pass with the emission cut at the nearest back face.
/// `automatic` is exact where that is wanted, 2-pass where nothing can overlap, otherwise 4-pass.
FramePlan planFrame(const PlanInput& input);

}  // namespace isoglass
