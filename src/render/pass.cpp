#include "render/pass.h"

#include "render/draw_recorder.h"

#include <algorithm>
#include <array>
#include <set>
#include <stdexcept>
#include <utility>

namespace isoglass {
namespace {

using gl::Blend;
using gl::DepthTest;

constexpr const char* kFullScreen = "full_screen.vert";

constexpr std::array<std::string_view, kTargetCount> kTargetNames{
    "opaque color",     "opaque depth",    "composed",       "nearest back depth", "layer color",
    "even layer depth", "odd layer depth", "sums",           "list heads",         "linear image",
    "sRGB image",       "first surface",   "second surface", "secondary shade"};

Target layerDepth(int layer) {
    return layer % 2 == 0 ? Target::layerDepthEven : Target::layerDepthOdd;
}

/// Declares the passes of one plan.
class Declarer {
  public:
    Declarer(const FramePlan& plan, int subframe)
        : plan_(plan), hasOpaque_(plan.runs(PassKind::opaque)), isFirst_(subframe == 0) {}

    PassDeclaration declare(const PlannedPass& planned) const {
        switch (planned.kind) {
            case PassKind::opaque:
                return opaque(planned);
            case PassKind::layers:
                return throughVolume(planned, "layers.frag");
            case PassKind::shadedVolume:
                return throughVolume(planned, "volume.frag");
            case PassKind::firstSurface:
                return seenSurface(planned, 0, Target::firstSurface);
            case PassKind::secondSurface:
                return seenSurface(planned, 1, Target::secondSurface);
            case PassKind::secondaryGeometry:
                return secondaryGeometry(planned);
            case PassKind::illustration:
                return illustration(planned);
            case PassKind::backFaceDepth:
                return backFaceDepth(planned);
            case PassKind::blending:
                return composing(planned, "blending.frag", Blend::over);
            case PassKind::attenuationAndEmission:
                return limited(composing(planned, "attenuation_and_emission.frag", Blend::emitAndDim));
            case PassKind::integerSums:
                return limited(counting(planned, "integer_sums.frag", Target::sums));
            case PassKind::peeledLayer:
                return peeledLayer(planned);
            case PassKind::layerBlend:
                return layerBlend(planned);
            case PassKind::fragmentLists:
                return counting(planned, "fragment_lists.frag", Target::listHeads);
            case PassKind::resolve:
                return resolve(planned);
            case PassKind::accumulation:
                return accumulation(planned);
            case PassKind::presentation:
                break;
        }
        PassDeclaration pass = fullScreen(planned, "present.frag");
        pass.reads = {Target::linearImage};
        pass.writes = {{Target::srgbImage}};
        return pass;
    }

  private:
    static PassDeclaration geometry(const PlannedPass& planned, const char* vertexShader,
                                    const char* fragmentShader) {
        return {.planned = planned,
                .vertexShader = vertexShader,
                .fragmentShader = fragmentShader,
                .record = [](DrawRecorder& recorder) { recorder.drawSemiTransparent(); }};
    }

    static PassDeclaration fullScreen(const PlannedPass& planned, const char* fragmentShader) {
        return {.planned = planned,
                .vertexShader = kFullScreen,
                .fragmentShader = fragmentShader,
                .record = [](DrawRecorder& recorder) { recorder.drawFullScreen(); }};
    }

    static PassDeclaration opaque(const PlannedPass& planned) {
        PassDeclaration pass = geometry(planned, "surface.vert", "opaque.frag");
        pass.writes = {{Target::opaqueColor, Begin::fillBackground}};
        pass.depth = DepthUse{.target = Target::opaqueDepth, .clear = true};
        pass.state = {.depthTest = DepthTest::greater, .depthWrite = true};
        pass.record = [](DrawRecorder& recorder) { recorder.drawOpaque(); };
        return pass;
    }

    /// Over the opaque color, or over the background in its place.
    PassDeclaration throughVolume(const PlannedPass& planned, const char* fragmentShader) const {
        PassDeclaration pass = fullScreen(planned, fragmentShader);
        pass.writes = {{Target::opaqueColor, hasOpaque_ ? Begin::keep : Begin::fillBackground}};
        pass.state.blend[0] = Blend::cover;
        if (hasOpaque_) {
            pass.reads = {Target::opaqueDepth};
            pass.defines = {"OPAQUE_IN_FRONT"};
        }
        pass.record = [](DrawRecorder& recorder) { recorder.drawVolume(); };
        return pass;
    }

    /// Peeled like the layers of the method peel, but whatever is drawn is opaque.
    static PassDeclaration seenSurface(const PlannedPass& planned, int layer, Target target) {
        PassDeclaration pass = geometry(planned, "surface.vert", "seen_surface.frag");
        if (layer > 0) {
            pass.reads = {layerDepth(layer - 1)};
            pass.defines = {previousLayer(layer)};
        }
        pass.writes = {{target, Begin::fillZero}};
        pass.depth = DepthUse{.target = layerDepth(layer), .clear = true};
        pass.state = {.depthTest = DepthTest::greater, .depthWrite = true};
        pass.record = [](DrawRecorder& recorder) { recorder.drawPrimary(); };
        return pass;
    }

    PassDeclaration secondaryGeometry(const PlannedPass& planned) const {
        PassDeclaration pass = geometry(planned, "surface.vert", "secondary_geometry.frag");
        if (plan_.runs(PassKind::firstSurface)) {
            pass.reads = {Target::layerDepthEven, Target::layerDepthOdd};
            pass.defines = {"SURFACES"};
        }
        pass.writes = {{Target::secondaryShade, Begin::fillZero}};
        pass.depth = DepthUse{.target = Target::opaqueDepth, .clear = true};
        pass.state = {.depthTest = DepthTest::greater, .depthWrite = true};
        pass.record = [](DrawRecorder& recorder) { recorder.drawSecondary(); };
        return pass;
    }

    PassDeclaration illustration(const PlannedPass& planned) const {
        PassDeclaration pass = fullScreen(planned, "illustration.frag");
        pass.defines = {supersample()};
        if (plan_.runs(PassKind::firstSurface)) {
            pass.reads = {Target::firstSurface, Target::secondSurface};
            pass.defines.push_back("SURFACES");
        }
        if (plan_.runs(PassKind::secondaryGeometry)) {
            pass.reads.push_back(Target::secondaryShade);
            pass.defines.push_back("SECONDARY_GEOMETRY");
        }
        pass.writes = {{Target::opaqueColor, Begin::fillBackground}};
        pass.onlyAroundSurfaces = true;
        return pass;
    }

    /// A depth target that starts as the opaque depth.
    DepthUse startingOpaque(Target target) const {
        if (!hasOpaque_) return {.target = target, .clear = true};
        return {.target = target, .copyFrom = Target::opaqueDepth};
    }

    PassDeclaration backFaceDepth(const PlannedPass& planned) const {
        PassDeclaration pass = geometry(planned, "position.vert", "back_face_depth.frag");
        pass.depth = startingOpaque(Target::nearestBackDepth);
        pass.state = {
            .depthTest = DepthTest::greater, .depthWrite = true, .culling = gl::Culling::frontFaces};
        return pass;
    }

    /// Fragments at the very depth of an opaque surface count as in front of it, in every method.
    PassDeclaration inFrontOfOpaque(const PlannedPass& planned, const char* fragmentShader) const {
        PassDeclaration pass = geometry(planned, "surface.vert", fragmentShader);
        if (hasOpaque_) {
            pass.depth = DepthUse{.target = Target::opaqueDepth};
            pass.state.depthTest = DepthTest::greaterOrEqual;
        }
        return pass;
    }

    PassDeclaration composing(const PlannedPass& planned, const char* fragmentShader, Blend blend) const {
        PassDeclaration pass = inFrontOfOpaque(planned, fragmentShader);
        pass.writes = {{Target::composed, Begin::fillClear}};
        pass.state.blend[0] = blend;
        return pass;
    }

    PassDeclaration counting(const PlannedPass& planned, const char* fragmentShader, Target image) const {
        PassDeclaration pass = inFrontOfOpaque(planned, fragmentShader);
        pass.image = image;
        return pass;
    }

    /// Cuts the emission at the nearest back face.
    PassDeclaration limited(PassDeclaration pass) const {
        if (plan_.method != TransparencyMethod::fourPass || !plan_.runs(PassKind::backFaceDepth)) return pass;
        pass.defines.push_back("CUT_EMISSION");
        pass.reads.push_back(Target::nearestBackDepth);
        return pass;
    }

    PassDeclaration peeledLayer(const PlannedPass& planned) const {
        PassDeclaration pass = geometry(planned, "surface.vert", "peeled_layer.frag");
        if (planned.layer > 0) {
            pass.reads = {layerDepth(planned.layer - 1)};
            pass.defines = {previousLayer(planned.layer)};
        }
        pass.writes = {{Target::layerColor, Begin::fillZero}};
        pass.depth = startingOpaque(layerDepth(planned.layer));
        pass.state = {.depthTest = DepthTest::greaterOrEqual, .depthWrite = true};
        return pass;
    }

    static PassDeclaration layerBlend(const PlannedPass& planned) {
        PassDeclaration pass = fullScreen(planned, "layer_blend.frag");
        pass.reads = {Target::layerColor};
        pass.writes = {{Target::composed, planned.layer == 0 ? Begin::fillClear : Begin::keep}};
        pass.state.blend[0] = Blend::under;
        return pass;
    }

    /// What the resolve reads: that of the method, as far as its passes run.
    std::pair<const char*, std::optional<Target>> whatIsInFront() const {
        using Method = TransparencyMethod;
        const bool sums = plan_.method == Method::threePass || plan_.method == Method::fourPass;
        const bool lists = plan_.method == Method::exact || plan_.method == Method::peel;
        if (lists && (plan_.method == Method::exact || plan_.reproducible)) {
            if (plan_.runs(PassKind::fragmentLists)) return {"resolve_lists.frag", Target::listHeads};
        } else if (sums && plan_.reproducible) {
            if (plan_.runs(PassKind::integerSums)) return {"resolve_sums.frag", Target::sums};
        } else if (plan_.runs(sums    ? PassKind::attenuationAndEmission
                              : lists ? PassKind::layerBlend
                                      : PassKind::blending)) {
            return {"resolve_composed.frag", Target::composed};
        }
        return {"resolve_behind.frag", std::nullopt};
    }

    PassDeclaration resolve(const PlannedPass& planned) const {
        const auto [shader, front] = whatIsInFront();
        PassDeclaration pass = fullScreen(planned, shader);
        if (front) pass.reads.push_back(*front);
        const auto drawn = {PassKind::opaque, PassKind::layers, PassKind::shadedVolume,
                            PassKind::illustration};
        if (std::ranges::any_of(drawn, [this](PassKind kind) { return plan_.runs(kind); })) {
            pass.reads.push_back(Target::opaqueColor);
            pass.defines.push_back("OPAQUE_BEHIND");
        }
        if (plan_.supersample > 1) pass.defines.push_back(supersample());
        pass.writes = {{Target::srgbImage}};
        return pass;
    }

    PassDeclaration accumulation(const PlannedPass& planned) const {
        PassDeclaration pass = resolve(planned);
        pass.defines.push_back("KEEP_LINEAR");
        pass.writes = {{Target::linearImage, isFirst_ ? Begin::fillZero : Begin::keep}};
        pass.state.blend[0] = Blend::add;
        return pass;
    }

    /// Where the depth of the layer before is read.
    static std::string previousLayer(int layer) {
        return "PREVIOUS_LAYER " + std::to_string(static_cast<int>(layerDepth(layer - 1)));
    }

    std::string supersample() const { return "SUPERSAMPLE " + std::to_string(plan_.supersample); }

    const FramePlan& plan_;
    const bool hasOpaque_;
    const bool isFirst_;
};

[[noreturn]] void throwFlow(const PassDeclaration& pass, Target target, const char* what) {
    throw std::logic_error("pass " + passLabel(pass.planned) + ": " + what + " " +
                           std::string(targetName(target)));
}

}  // namespace

std::string_view targetName(Target target) {
    return kTargetNames[static_cast<std::size_t>(target)];
}

bool PassDeclaration::usesLists() const {
    const bool isRead = std::find(reads.begin(), reads.end(), Target::listHeads) != reads.end();
    return isRead || (image && *image == Target::listHeads);
}

std::vector<PassDeclaration> declarePasses(const FramePlan& plan, int subframe) {
    const Declarer declarer(plan, subframe);
    std::vector<PassDeclaration> passes;
    for (const PlannedPass& planned : plan.passes) {
        if (planned.kind == PassKind::presentation && subframe + 1 < plan.subframes) continue;
        passes.push_back(declarer.declare(planned));
    }
    return passes;
}

void specialize(std::span<PassDeclaration> passes, const VolumeVariant& variant) {
    for (PassDeclaration& pass : passes) {
        if (pass.planned.kind != PassKind::layers && pass.planned.kind != PassKind::shadedVolume) continue;
        pass.defines.insert(pass.defines.end(), variant.defines.begin(), variant.defines.end());
        pass.volumeUnits = variant.units;
    }
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
            // Blending goes on with what is there; the linear image is that of the picture before.
            const bool goesOn = write.begin == Begin::keep && pass.state.blend[0] != Blend::replace;
            if (goesOn && write.target != Target::linearImage) need(write.target);
            written.insert(write.target);
        }
        if (pass.image) written.insert(*pass.image);
        if (!pass.depth) continue;
        if (pass.depth->copyFrom) need(*pass.depth->copyFrom);
        if (!pass.depth->copyFrom && !pass.depth->clear) need(pass.depth->target);
        if (pass.depth->clear || pass.depth->copyFrom) written.insert(pass.depth->target);
    }
}

}  // namespace isoglass
