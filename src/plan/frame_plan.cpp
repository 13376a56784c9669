#include "plan/frame_plan.h"

#include <algorithm>

namespace isoglass {
namespace {

constexpr const char* kNothingSemiTransparent = "no semi-transparent surface is visible";

FramePlan planOpaqueOnly(FramePlan plan) {
    plan.passes.push_back({PassKind::resolve, "applies exposure and the sRGB curve"});
    for (const PassKind kind : {PassKind::attenuation, PassKind::emission, PassKind::attenuationAndEmission,
                                PassKind::backFaceDepth}) {
        plan.leftOut.push_back({kind, kNothingSemiTransparent});
    }
    return plan;
}

FramePlan planThreePass(FramePlan plan, bool separatePasses) {
    plan.leftOut.push_back({PassKind::backFaceDepth, "the 3-pass method adds the emission of all surfaces"});
    if (separatePasses) {
        plan.passes.push_back({PassKind::attenuation, "semi-transparent surfaces dim what is behind them"});
        plan.passes.push_back({PassKind::emission, "semi-transparent surfaces add their own light"});
        plan.leftOut.push_back({PassKind::attenuationAndEmission, "separate passes were asked for"});
    } else {
        plan.passes.push_back({PassKind::attenuationAndEmission,
                               "the same fragments attenuate and emit, so one walk over them serves both"});
        for (const PassKind kind : {PassKind::attenuation, PassKind::emission}) {
            plan.leftOut.push_back({kind, "part of the pass that attenuates and emits"});
        }
    }
    return plan;
}

FramePlan planFourPass(FramePlan plan) {
    plan.passes.push_back({PassKind::attenuation, "semi-transparent surfaces dim what is behind them"});
    plan.passes.push_back({PassKind::backFaceDepth, "the 4-pass method shows no emission beyond it"});
    plan.passes.push_back({PassKind::emission, "surfaces up to the nearest back face add their own light"});
    plan.leftOut.push_back(
        {PassKind::attenuationAndEmission, "in the 4-pass method fewer fragments emit than attenuate"});
    return plan;
}

}  // namespace

std::string_view passName(PassKind kind) {
    switch (kind) {
        case PassKind::opaque:
            return "opaque";
        case PassKind::attenuation:
            return "attenuation";
        case PassKind::emission:
            return "emission";
        case PassKind::attenuationAndEmission:
            return "attenuation and emission";
        case PassKind::backFaceDepth:
            return "back-face depth";
        case PassKind::resolve:
            return "resolve";
    }
    return {};
}

bool FramePlan::runs(PassKind kind) const {
    return std::any_of(passes.begin(), passes.end(), [kind](const auto& pass) { return pass.kind == kind; });
}

FramePlan planFrame(const PlanInput& input) {
    const bool threePass = input.method == TransparencyMethod::threePass;
    FramePlan plan{threePass ? TransparencyMethod::threePass : TransparencyMethod::fourPass, {}, {}};
    plan.passes.push_back({PassKind::opaque, input.opaqueSurfaces > 0
                                                 ? "opaque surfaces are visible"
                                                 : "gives the background; no opaque surface is visible"});
    if (input.semiTransparentSurfaces == 0) return planOpaqueOnly(std::move(plan));
    plan = threePass ? planThreePass(std::move(plan), input.separatePasses) : planFourPass(std::move(plan));
    plan.passes.push_back({PassKind::resolve, "joins background, transmittance and emission"});
    return plan;
}

}  // namespace isoglass
