// IEC 61966-2-1: the exact piecewise curve, on values clamped to [0, 1].
vec3 srgbFromLinear(vec3 linearColor) {
    vec3 c = clamp(linearColor, 0.0, 1.0);
    return mix(1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, 12.92 * c, lessThanEqual(c, vec3(0.0031308)));
}
