#include "plan/frame_plan.h"

#include "scene/transparency.h"

#include <algorithm>
#include <array>
#include <tuple>
#include <utility>

namespace isoglass {
namespace {

using enum PassKind;
using Method = TransparencyMethod;

constexpr std::array<std::string_view, kPassKindCount> kNames{"opaque",         "layers",
                                                              "shaded volume",  "first surface",
                                                              "second surface", "secondary geometry",
                                                              "illustration",   "back-face depth",
                                                              "blending",       "attenuation and emission",
                                                              "integer sums",   "peeled layer",
                                                              "layer blend",    "fragment lists",
                                                              "resolve",        "accumulation",
                                                              "presentation"};

std::pair<Method, std::string> chooseMethod(const PlanInput& input) {
    if (input.method != Method::automatic) return {input.method, "the scene asks for it"};
    if (input.exactWanted) return {Method::exact, "the wanted quality asks for the exact order"};
    if (input.overlapImpossible && input.semiTransparentSurfaces > 0) {
        return {Method::twoPass, "the one semi-transparent surface is flat: nothing overlaps in any view"};
    }
    return {Method::fourPass, "semi-transparent surfaces may overlap, and their order in depth shows"};
}

void add(FramePlan& plan, PassKind kind, std::string reason, int layer = 0) {
    plan.passes.push_back({kind, std::move(reason), layer});
}

void planSums(FramePlan& plan, bool reproducible) {
    if (reproducible) {
        add(plan, integerSums, "integers add up to the same bits in any order");
    } else {
        add(plan, attenuationAndEmission,
            "semi-transparent surfaces dim what is behind them and add their own light, in one walk");
    }
}

void planComposition(FramePlan& plan, const PlanInput& input) {
    switch (plan.method) {
        case Method::twoPass:
            return add(plan, blending, "blends semi-transparent surfaces in the order of the draws");
        case Method::threePass:
            return planSums(plan, input.reproducible);
        case Method::automatic:
        case Method::fourPass:
            add(plan, backFaceDepth, "the 4-pass method shows no emission beyond it");
            return planSums(plan, input.reproducible);
        case Method::exact:
            return add(plan, fragmentLists, "keeps every fragment, to be sorted in each pixel");
        case Method::peel:
            break;
    }
    if (input.reproducible) {
        return add(plan, fragmentLists,
                   "sorted lists give the nearest layers in an order that no draw order changes");
    }
    for (int layer = 0; layer < input.layers; ++layer) {
        const std::string number = std::to_string(layer + 1);
        add(plan, peeledLayer, "finds layer " + number + " of " + std::to_string(input.layers), layer);
        add(plan, layerBlend, "puts layer " + number + " behind those before it", layer);
    }
}

void planIllustration(FramePlan& plan, const PlanInput& input) {
    if (input.primarySurfaces > 0) {
        add(plan, firstSurface,
            "silhouettes and hatching come from the normals and distances that are seen first");
        add(plan, secondSurface, "what the first surface hides is drawn as silhouettes");
    }
    if (input.secondarySurfaces > 0)
        add(plan, secondaryGeometry, "secondary geometry is visible behind the surfaces, darker behind each");
    add(plan, illustration, "finds silhouettes, hatches, and puts the drawing together");
}

/// One sample a pixel is the center. Four are drawn at twice the size, so the geometry is walked once;
/// more than that are averaged over pictures, 4 samples each where they come in fours.
void planSamples(FramePlan& plan, const PlanInput& input) {
    plan.supersample = input.samples % 4 == 0 ? 2 : 1;
    plan.subframes = input.samples / (plan.supersample * plan.supersample);
    if (plan.subframes == 1 && !input.keepLinear) {
        return add(plan, resolve, "joins what is behind and in front, applies exposure and the sRGB curve");
    }
    add(plan, accumulation,
        plan.subframes > 1
            ? std::to_string(plan.subframes) + " pictures with shifted samples are averaged in linear light"
            : "the linear image is asked for");
    add(plan, presentation, "applies exposure and the sRGB curve to the linear image");
}

bool isIllustrative(PassKind kind) {
    return kind == firstSurface || kind == secondSurface || kind == secondaryGeometry || kind == illustration;
}

std::string whyNot(PassKind kind, const FramePlan& plan, const PlanInput& input) {
    if (input.unchanged) return "nothing has changed since the last frame";
    if (kind == opaque && !input.illustrative)
        return "no opaque surface is visible, and the background needs no drawing";
    if (kind == layers) return "no volume is shown in layers";
    if (kind == shadedVolume) return "no volume is shown as a medium";
    if (kind == illustration || (isIllustrative(kind) && !input.illustrative))
        return "the style is not illustrative";
    if (kind == secondaryGeometry) return "no secondary geometry is visible";
    if (isIllustrative(kind)) return "no surface is visible that is not secondary";
    if (kind == resolve) return "the linear image comes first";
    if (kind == accumulation || kind == presentation) {
        return "one picture is enough, and nobody asks for the linear image";
    }
    if (input.illustrative) return "the illustrative style draws lines, not lit surfaces";
    if (input.semiTransparentSurfaces == 0) return "no semi-transparent surface is visible";
    const bool sums = plan.method == Method::threePass || plan.method == Method::fourPass;
    if (sums && kind == integerSums) return "float sums are enough unless the frame must be reproducible";
    if (sums && kind == attenuationAndEmission) return "float sums depend on the order in their last bits";
    if (plan.method == Method::peel && kind == peeledLayer) return "the layers come from the fragment lists";
    if (plan.method == Method::threePass && kind == backFaceDepth) {
        return "the 3-pass method adds the emission of all surfaces";
    }
    return "the method " + std::string(transparencyMethodName(plan.method)) + " does not need it";
}

}  // namespace

std::string_view passName(PassKind kind) {
    return kNames[static_cast<std::size_t>(kind)];
}

std::string passLabel(const PlannedPass& pass) {
    const bool numbered = pass.kind == peeledLayer || pass.kind == layerBlend;
    return std::string(passName(pass.kind)) + (numbered ? " " + std::to_string(pass.layer + 1) : "");
}

bool FramePlan::runs(PassKind kind) const {
    return std::any_of(passes.begin(), passes.end(), [kind](const auto& pass) { return pass.kind == kind; });
}

FramePlan planFrame(const PlanInput& input) {
    FramePlan plan;
    std::tie(plan.method, plan.methodReason) = chooseMethod(input);
    plan.reproducible = input.reproducible;
    if (!input.unchanged) {
        if (input.opaqueSurfaces > 0) add(plan, opaque, "opaque surfaces are visible");
        if (input.layerStyle) {
            add(plan, layers,
                input.betweenKeyFrames
                    ? "rays count the layers of an iso-surface in the samples of two key frames"
                    : "rays count the layers of an iso-surface in the samples of one key frame");
        }
        if (input.shadedVolume) {
            add(plan, shadedVolume,
                input.betweenKeyFrames ? "rays gather the light of the samples of two key frames"
                                       : "rays gather the light of the samples of one key frame");
        }
        if (input.illustrative) planIllustration(plan, input);
        if (input.semiTransparentSurfaces > 0) planComposition(plan, input);
        planSamples(plan, input);
    }
    for (int i = 0; i < kPassKindCount; ++i) {
        const auto kind = static_cast<PassKind>(i);
        if (!plan.runs(kind)) plan.leftOut.push_back({kind, whyNot(kind, plan, input)});
    }
    return plan;
}

}  // namespace isoglass
