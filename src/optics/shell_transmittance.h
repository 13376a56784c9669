#pragma once

#include "scene/shell_opacity.h"

#include <optional>

namespace isoglass {

/// Half of a ray's way through the shell between the spheres of radius 1 and 1 - `thickness`: what one of
/// its two crossings stands for. `sine` is that of the angle between ray and normal on the outer sphere.
double shellChord(double sine, double thickness);

/// exp(-extinction * chord); S. Roettger, "Volume rendering with libMini", 2007, Figure 4.
double shellTransmittance(double sine, double extinction, double thickness);

/// cosine^power - offset, the curve that stands for a shell's transmittance.
struct CosineFit {
    double power;
    double offset;  ///< may be negative
    double rms;     ///< of fit - transmittance over the fitted sines
    double largest;

    friend bool operator==(const CosineFit&, const CosineFit&) = default;
};

/// Non-linear least squares over the middles of 1000 equal parts of the sines from 0 to the inner radius:
/// beyond it the transmittance returns to 1 at the rim, which no cosine follows. `extinction` is above 0,
/// `thickness` between 0 and 1. With `power` only the offset is fitted. Pure.
CosineFit fitCosine(double extinction, double thickness, std::optional<double> power = {});

/// A model with all its numbers known; what shaders get.
struct PreparedShell {
    ShellOpacity shell;
    CosineFit fit{};  ///< only for the cosine model

    friend bool operator==(const PreparedShell&, const PreparedShell&) = default;
};

PreparedShell prepareShell(const ShellOpacity& shell);

/// Opacity of a fragment, 0 to 1, in double: what shaders/lib/opacity.glsl computes. `cosine` is that of the
/// angle between view and normal, of either sign; `gradient` is the gradient's length in world units.
double shellOpacity(const PreparedShell& prepared, double cosine, double gradient);

}  // namespace isoglass
