// What is seen of a surface at a pixel, in two integers: half of what four floats would take to read around a pixel.
// The distance along the view axis, 0 for nothing; the normal of the side that is seen, octahedral in 2 x 16 bits
// (Q. Meyer et al., "On Floating-Point Normal Vectors", 2010).
vec2 octahedral(vec3 normal) {
    vec2 p = normal.xy / (abs(normal.x) + abs(normal.y) + abs(normal.z));
    vec2 folded = (1.0 - abs(p.yx)) * mix(vec2(-1.0), vec2(1.0), greaterThanEqual(p, vec2(0.0)));
    return normal.z >= 0.0 ? p : folded;
}

uvec2 packedSurface(vec3 normal, float distance) {
    return uvec2(floatBitsToUint(distance), packSnorm2x16(octahedral(normal)));
}

float distanceOf(uvec2 texel) { return uintBitsToFloat(texel.x); }

vec3 normalOf(uvec2 texel) {
    vec2 p = unpackSnorm2x16(texel.y);
    vec3 normal = vec3(p, 1.0 - abs(p.x) - abs(p.y));
    float below = max(-normal.z, 0.0);
    normal.xy += mix(vec2(below), vec2(-below), greaterThanEqual(p, vec2(0.0)));
    return normalize(normal);
}
