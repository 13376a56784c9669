#include "lib/frame.glsl"
#include "lib/srgb.glsl"

// Linear color times alpha, as a picture shows it: exposure, the sRGB curve, and straight alpha, which is
// what files hold. Dividing by 1 is exact: an opaque background changes nothing.
vec4 presented(vec4 linearColor) {
    float alpha = linearColor.a;
    vec3 straight = alpha > 0.0 ? linearColor.rgb / alpha : vec3(0.0);
    return vec4(srgbFromLinear(straight * exposure), alpha);
}
