#pragma once

#include <array>
#include <cstddef>

namespace isoglass::gl {

/// Depth is reversed: 1 at the near plane, 0 at infinity, so `greater` is nearer.
enum class DepthTest { off, greater, greaterOrEqual };

enum class Culling { none, frontFaces, backFaces };

/// How a fragment output joins what the target holds.
enum class Blend {
    replace,
    add,         ///< target + output
    emitAndDim,  ///< RGB: target + output; alpha: target * (1 - output's alpha). Commutes.
    over,        ///< RGB: output + target * (1 - output's alpha); alpha as in emitAndDim
    under,       ///< RGB: target + target's alpha * output; alpha as in emitAndDim
    cover,       ///< RGB as in over; alpha: output + target * (1 - output), coverage
};

/// The fixed-function state that a pass declares.
struct PipelineState {
    static constexpr std::size_t kMaxTargets = 4;

    DepthTest depthTest = DepthTest::off;
    bool depthWrite = false;
    Culling culling = Culling::none;
    bool frontIsClockwise = false;  ///< for placements that mirror
    std::array<Blend, kMaxTargets> blend{};
    bool colorWrite = true;
    bool wireframe = false;  ///< triangles are drawn as their edges

    friend bool operator==(const PipelineState&, const PipelineState&) = default;
};

/// Applies pipeline states as differences to the one before.
///
/// One per context; nothing else may touch that state. The constructor also sets what never changes:
/// depth from 0 to 1 (reversed), no dithering.
class StateCache {
  public:
    StateCache();

    /// Returns how many of the members differed and were sent to GL; blending counts once a target.
    int apply(const PipelineState& state);

  private:
    PipelineState current_;
};

}  // namespace isoglass::gl
