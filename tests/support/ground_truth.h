#pragma once

#include "render/frame_description.h"
#include "render/image.h"
#include "support/cpu_compositor.h"

#include <functional>
#include <vector>

namespace isoglass::test {

/// What a whole picture must look like, in double precision: the ray through the center of every pixel
/// meets every triangle, the hits are sorted, `compose` says what they look like.
struct TruthImage {
    LinearImage color;
    /// Pixels that a sample may leave for its neighbour: the surfaces that rays around the center meet
    /// are not the same, so the smallest displacement of an edge decides. Silhouettes, in short; also
    /// where surfaces cross each other.
    Raster<std::uint8_t> silhouette;
    std::size_t deepest = 0;  ///< most fragments of a pixel

    std::size_t silhouettePixels() const;
};

/// Turns the fragments of a ray, nearest first, into its linear color.
using Composer = std::function<glm::dvec3(const std::vector<Fragment>&)>;

struct TruthOptions {
    /// How far from the center a ray may be displaced before its surfaces must stay the same, in pixels.
    /// A rasterizer rounds projected corners to a grid of 1/256 pixel, half a step each way, and float
    /// matrices displace them by less than another; 1/64 leaves room for slanting edges.
    double silhouetteRadius = 1.0 / 64;
    int threads = 0;  ///< 0 takes all cores; the picture does not depend on it
};

/// Draws `surfaces` as `frame` says (camera, lighting; its draws and method are not looked at). Hits of
/// one surface at a shared edge or corner of its triangles count once. Time follows pixels times
/// triangles near them; small pictures are enough.
TruthImage renderTruth(const FrameDescription& frame, const std::vector<TruthSurface>& surfaces,
                       const Composer& compose, const TruthOptions& options = {});

/// The composer of an engine's method, by the closed form in `compose`.
Composer composerOf(const FrameDescription& frame);

}  // namespace isoglass::test
