#pragma once

#include "gl/pipeline_state.h"
#include "plan/frame_plan.h"

#include <array>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace isoglass {

class DrawRecorder;

/// Images that passes write and later ones read. The number is the texture unit at which shaders read it.
enum class Target {
    opaqueColor,       ///< RGB linear times alpha, 32-bit float; alpha is 1 but for the background's
    opaqueDepth,       ///< 32-bit float, reversed; only opaque things write it
    transmittance,     ///< product of (1 - opacity), 32-bit float
    emission,          ///< RGB linear, 32-bit float
    nearestBackDepth,  ///< nearer one of opaqueDepth and the nearest semi-transparent back face
    linearImage,       ///< the picture before exposure, RGB times alpha, 32-bit float, size of the image
    srgbImage,         ///< the picture with straight alpha, 8 bits, size of the image
};
inline constexpr std::size_t kTargetCount = 7;

std::string_view targetName(Target target);

/// A color target that a pass writes: fragment output i goes to the i-th.
struct ColorWrite {
    Target target;
    /// What to do first: fill with a color; nothing where the pass covers every pixel.
    enum class Begin { keep, fillBackground, fillZero, fillOne } begin = Begin::keep;
};

/// The depth target that a pass tests against and, where its state says so, writes.
struct DepthUse {
    Target target;
    bool clear = false;                ///< to infinity first
    std::optional<Target> copyFrom{};  ///< start as a copy of this one
};

/// A pass as data. The executor alone binds targets, applies state, pushes debug groups and times.
struct PassDeclaration {
    PassKind kind;
    std::string reason;  ///< from the plan
    const char* vertexShader;
    const char* fragmentShader;
    std::vector<Target> reads;  ///< as textures
    std::vector<ColorWrite> writes;
    std::optional<DepthUse> depth;
    gl::PipelineState state;
    std::function<void(DrawRecorder&)> record;  ///< called once, inside the pass
};

/// The declarations of a plan's passes, in its order.
std::vector<PassDeclaration> declarePasses(const FramePlan& plan);

/// Makes every pass over the surfaces draw their triangles' edges; those over the whole image stay.
void drawWireframe(std::span<PassDeclaration> passes);

/// Throws std::logic_error where a pass reads or goes on from a target that no pass before it wrote, or
/// reads one that it writes itself.
void checkDataFlow(std::span<const PassDeclaration> passes);

}  // namespace isoglass
