#include "render/pass.h"

#include "render/draw_recorder.h"

#include <algorithm>
#include <set>
#include <stdexcept>

namespace isoglass {
namespace {

using gl::Blend;
using gl::Culling;
using gl::DepthTest;
using gl::PipelineState;
using Begin = ColorWrite::Begin;

constexpr const char* kFullScreen = "full_screen.vert";

void drawOpaque(DrawRecorder& recorder) {
    recorder.drawOpaque();
}
void drawSemiTransparent(DrawRecorder& recorder) {
    recorder.drawSemiTransparent();
}
void drawFullScreen(DrawRecorder& recorder) {
    recorder.drawFullScreen();
}

PassDeclaration opaquePass(const PlannedPass& planned) {
    PipelineState state;
    state.depthTest = DepthTest::greater;
    state.depthWrite = true;
    return {.kind = planned.kind,
            .reason = planned.reason,
            .vertexShader = "surface.vert",
            .fragmentShader = "opaque.frag",
            .reads = {},
            .writes = {{Target::opaqueColor, Begin::fillBackground}},
            .depth = DepthUse{.target = Target::opaqueDepth, .clear = true},
            .state = state,
            .record = drawOpaque};
}

/// Fragments at the very depth of an opaque surface count as in front of it, in attenuation and emission
/// alike.
PassDeclaration attenuationPass(const PlannedPass& planned) {
    PipelineState state;
    state.depthTest = DepthTest::greaterOrEqual;
    state.blend[0] = Blend::multiply;
    return {.kind = planned.kind,
            .reason = planned.reason,
            .vertexShader = "position.vert",
            .fragmentShader = "attenuation.frag",
            .reads = {},
            .writes = {{Target::transmittance, Begin::fillOne}},
            .depth = DepthUse{.target = Target::opaqueDepth},
            .state = state,
            .record = drawSemiTransparent};
}

PassDeclaration emissionPass(const PlannedPass& planned, Target emissionLimit) {
    PipelineState state;
    state.depthTest = DepthTest::greaterOrEqual;
    state.blend[0] = Blend::add;
    return {.kind = planned.kind,
            .reason = planned.reason,
            .vertexShader = "surface.vert",
            .fragmentShader = "emission.frag",
            .reads = {},
            .writes = {{Target::emission, Begin::fillZero}},
            .depth = DepthUse{.target = emissionLimit},
            .state = state,
            .record = drawSemiTransparent};
}

PassDeclaration attenuationAndEmissionPass(const PlannedPass& planned) {
    PipelineState state;
    state.depthTest = DepthTest::greaterOrEqual;
    state.blend[0] = Blend::multiply;
    state.blend[1] = Blend::add;
    return {.kind = planned.kind,
            .reason = planned.reason,
            .vertexShader = "surface.vert",
            .fragmentShader = "attenuation_and_emission.frag",
            .reads = {},
            .writes = {{Target::transmittance, Begin::fillOne}, {Target::emission, Begin::fillZero}},
            .depth = DepthUse{.target = Target::opaqueDepth},
            .state = state,
            .record = drawSemiTransparent};
}

PassDeclaration backFaceDepthPass(const PlannedPass& planned) {
    PipelineState state;
    state.depthTest = DepthTest::greater;
    state.depthWrite = true;
    state.culling = Culling::frontFaces;
    return {.kind = planned.kind,
            .reason = planned.reason,
            .vertexShader = "position.vert",
            .fragmentShader = "back_face_depth.frag",
            .reads = {},
            .writes = {},
            .depth = DepthUse{.target = Target::nearestBackDepth, .copyFrom = Target::opaqueDepth},
            .state = state,
            .record = drawSemiTransparent};
}

PassDeclaration resolvePass(const PlannedPass& planned, bool composed) {
    std::vector<Target> reads{Target::opaqueColor};
    if (composed) reads.insert(reads.end(), {Target::transmittance, Target::emission});
    return {.kind = planned.kind,
            .reason = planned.reason,
            .vertexShader = kFullScreen,
            .fragmentShader = composed ? "resolve_composed.frag" : "resolve_opaque.frag",
            .reads = std::move(reads),
            .writes = {{Target::linearImage}, {Target::srgbImage}},
            .depth = std::nullopt,
            .state = {},
            .record = drawFullScreen};
}

[[noreturn]] void throwFlow(const PassDeclaration& pass, Target target, const char* what) {
    throw std::logic_error("pass " + std::string(passName(pass.kind)) + ": " + what + " " +
                           std::string(targetName(target)));
}

}  // namespace

std::string_view targetName(Target target) {
    switch (target) {
        case Target::opaqueColor:
            return "opaque color";
        case Target::opaqueDepth:
            return "opaque depth";
        case Target::transmittance:
            return "transmittance";
        case Target::emission:
            return "emission";
        case Target::nearestBackDepth:
            return "nearest back depth";
        case Target::linearImage:
            return "linear image";
        case Target::srgbImage:
            return "sRGB image";
    }
    return {};
}

std::vector<PassDeclaration> declarePasses(const FramePlan& plan) {
    const bool cutsEmission = plan.runs(PassKind::backFaceDepth);
    const bool composed = plan.runs(PassKind::emission) || plan.runs(PassKind::attenuationAndEmission);
    std::vector<PassDeclaration> passes;
    for (const PlannedPass& planned : plan.passes) {
        switch (planned.kind) {
            case PassKind::opaque:
                passes.push_back(opaquePass(planned));
                break;
            case PassKind::attenuation:
                passes.push_back(attenuationPass(planned));
                break;
            case PassKind::emission:
                passes.push_back(
                    emissionPass(planned, cutsEmission ? Target::nearestBackDepth : Target::opaqueDepth));
                break;
            case PassKind::attenuationAndEmission:
                passes.push_back(attenuationAndEmissionPass(planned));
                break;
            case PassKind::backFaceDepth:
                passes.push_back(backFaceDepthPass(planned));
                break;
            case PassKind::resolve:
                passes.push_back(resolvePass(planned, composed));
                break;
        }
    }
    return passes;
}

void drawWireframe(std::span<PassDeclaration> passes) {
    for (PassDeclaration& pass : passes)
        pass.state.wireframe = pass.vertexShader != std::string_view(kFullScreen);
}

void checkDataFlow(std::span<const PassDeclaration> passes) {
    std::set<Target> written;
    for (const PassDeclaration& pass : passes) {
        const auto need = [&](Target target) {
            if (!written.contains(target)) throwFlow(pass, target, "nothing wrote");
        };
        for (const Target target : pass.reads) need(target);
        for (const ColorWrite& write : pass.writes) {
            if (std::find(pass.reads.begin(), pass.reads.end(), write.target) != pass.reads.end()) {
                throwFlow(pass, write.target, "reads and writes");
            }
            written.insert(write.target);
        }
        if (!pass.depth) continue;
        if (pass.depth->copyFrom) need(*pass.depth->copyFrom);
        if (!pass.depth->copyFrom && !pass.depth->clear) need(pass.depth->target);
        if (pass.depth->clear || pass.depth->copyFrom) written.insert(pass.depth->target);
    }
}

}  // namespace isoglass
