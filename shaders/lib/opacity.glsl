#include "lib/draw.glsl"
#include "lib/surface.glsl"

const int kSlab = 1;
const int kCosine = 2;
const int kIsoSpectrum = 3;

// Thickness of the slab in world units: given, or iso-width over gradient up to a limit.
float slabThickness() {
    if (thickness > 0.0) return thickness;
    float largest = largestComponent(surface.normal);
    if (largest == 0.0) return maxThickness;
    float gradient = gradientScale * largest * length(surface.normal / largest);
    return gradient * maxThickness > isoWidth ? isoWidth / gradient : maxThickness;
}

// Opacity of a fragment of a semi-transparent surface: shellOpacity() of src/optics in single precision.
float fragmentOpacity() {
    if (opacityModel == 0) return colorOpacity.a;
    float cosine = min(cosineOfView(), 1.0);
    if (opacityModel == kSlab) return 1.0 - exp(-extinction * slabThickness() / max(cosine, 1e-6));
    if (opacityModel == kCosine) {
        // pow is undefined at 0.
        float power = cosine > 0.0 ? pow(cosine, cosinePower) : 0.0;
        return 1.0 - clamp(power - cosineOffset, 0.0, 1.0);
    }
    // sqrt(1 - sin^2) - sqrt(inner^2 - sin^2) as a quotient: the difference of two like numbers would lose
    // digits where the shell is thin.
    float beyond = max(0.0, cosine * cosine - thickness * (2.0 - thickness));
    float chord = beyond > 0.0 ? thickness * (2.0 - thickness) / (cosine + sqrt(beyond)) : cosine;
    return 1.0 - exp(-extinction * chord);
}
