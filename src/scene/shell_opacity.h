#pragma once

#include <optional>

namespace isoglass {

/// Opacity of a surface that stands for a thin shell of absorbing matter, by the angle between view and
/// normal.
///
/// `slab`: a flat layer. `isoSpectrum`: the shell between two concentric spheres, each ray crossing it at its
/// true chord. `cosine`: S. Roettger's fit to that shell (Volume rendering with libMini, 2007, Figure 4):
/// transmittance |cos|^power - offset. Which numbers count and their units depend on the model.
struct ShellOpacity {
    enum class Model { slab, cosine, isoSpectrum };

    Model model = Model::slab;
    /// Extinction per world unit for `slab`, per radius of the outer sphere for the others.
    float extinction = 0;
    /// World units for `slab`, where 0 takes it from `isoWidth`; else the part of the outer radius, between 0
    /// and 1.
    float thickness = 0;
    /// Only `slab`: the shell lies between iso and iso + isoWidth, so that its thickness is isoWidth /
    /// |gradient|.
    float isoWidth = 0;
    /// Only with `isoWidth`: the most that a vanishing gradient makes of the thickness, world units.
    float maxThickness = 0;
    /// Only `cosine`: fixes the power; else it is fitted like the offset.
    std::optional<float> power{};

    friend bool operator==(const ShellOpacity&, const ShellOpacity&) = default;
};

}  // namespace isoglass
