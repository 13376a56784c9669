#pragma once

#include "gl/pipeline_state.h"
#include "plan/frame_plan.h"
#include "render/volume_recorder.h"

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
    composed,          ///< RGB emission, A transmittance of what is semi-transparent; 32-bit float
    nearestBackDepth,  ///< nearer one of opaqueDepth and the nearest semi-transparent back face
    layerColor,        ///< RGB emission, A opacity of one peeled layer; 32-bit float
    layerDepthEven,    ///< depth of the peeled layers 0, 2, ...; the first surface of an illustration
    layerDepthOdd,     ///< depth of the peeled layers 1, 3, ...; the second surface of an illustration
    sums,              ///< integers, 5 layers: see shaders/lib/integer_sums.glsl
    listHeads,         ///< integers: first node of a pixel's fragment list
    linearImage,       ///< the picture before exposure, RGB times alpha, 32-bit float, size of the image
    srgbImage,         ///< the picture with straight alpha, 8 bits, size of the image
    firstSurface,      ///< integers: distance and normal, see shaders/lib/seen_surface.glsl
    secondSurface,     ///< the same of the second surface
    secondaryShade,    ///< RGB color, A brightness of secondary geometry, negative behind the second surface
};
inline constexpr std::size_t kTargetCount = 14;

std::string_view targetName(Target target);

/// What a pass does first with a target.
enum class Begin {
    keep,            ///< nothing: it goes on, or covers every pixel
    fillBackground,  ///< the frame's background
    fillZero,        ///< 0
    fillClear,       ///< no emission, transmittance 1
};

/// A color target that a pass writes: fragment output i goes to the i-th.
struct ColorWrite {
    Target target;
    Begin begin = Begin::keep;
};

/// The depth target that a pass tests against and, where its state says so, writes.
struct DepthUse {
    Target target;
    bool clear = false;                ///< to infinity first
    std::optional<Target> copyFrom{};  ///< start as a copy of this one
};

/// A pass as data. The executor alone binds targets, applies state, pushes debug groups and times.
///
/// A pass that writes `listHeads` and the one behind it, which reads them, run together for one part of
/// the picture after another where not all fragments fit the memory.
struct PassDeclaration {
    PlannedPass planned;
    const char* vertexShader;
    const char* fragmentShader;
    std::vector<std::string> defines{};  ///< of the fragment shader
    std::vector<Target> reads{};         ///< as textures
    std::vector<ColorWrite> writes{};
    /// An integer target, filled with 0, that shaders change by atomic operations at image unit 0.
    std::optional<Target> image{};
    std::optional<DepthUse> depth{};
    /// After the targets have begun, only the part of the picture where surfaces may be is drawn.
    bool onlyAroundSurfaces = false;
    std::vector<int> volumeUnits{};  ///< texture units of a volume's samples
    gl::PipelineState state{};
    std::function<void(DrawRecorder&)> record;  ///< called once, inside the pass

    /// Whether the nodes of the fragment lists are used, too.
    bool usesLists() const;
};

/// The declarations of a plan's passes, in its order, for one of the plan's subframes: the first one
/// begins the linear image, the presentation comes with the last one.
std::vector<PassDeclaration> declarePasses(const FramePlan& plan, int subframe = 0);

/// Makes the passes that cast rays through a volume do so as it needs.
void specialize(std::span<PassDeclaration> passes, const VolumeVariant& variant);

/// Makes every pass over the surfaces draw their triangles' edges; those over the whole image stay.
void drawWireframe(std::span<PassDeclaration> passes);

/// Throws std::logic_error where a pass reads or goes on from a target that no pass before it wrote, or
/// reads one that it writes itself.
void checkDataFlow(std::span<const PassDeclaration> passes);

}  // namespace isoglass
