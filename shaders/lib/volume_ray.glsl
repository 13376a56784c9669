#include "lib/volume.glsl"

// The ray of a pixel through the volume; `clipPlace` is that of the full-screen triangle.
in vec2 clipPlace;

#ifdef OPAQUE_IN_FRONT
layout(binding = 1) uniform sampler2D opaqueDepth;
#endif

// Of a step, so that rounding does not stay in the brick.
const float kNudge = 1e-3;
// More than any volume has on a ray; without a bound a camera of NaNs would never end.
const int kMostLooks = 1 << 18;
// Less than that no 8-bit picture shows.
const float kOpaqueEnough = 1.0 / 1024.0;

vec3 start = vec3(0.0);  // where the ray enters, local: what is far away is measured from there
vec3 way = vec3(0.0);    // of the ray, local; t counts from the start
vec3 toEye = vec3(0.0);  // in the world, length 1
ivec3 cell = ivec3(0);
RayPart part = kNoPart;
float last = 0.0;        // t of the ray's end
float entry = 0.0;       // distance of the start along the view axis

void beginRay() {
    vec2 clip = clipPlace - shift;
    way = forward.xyz + clip.x * right.xyz + clip.y * up.xyz;
    toEye = -normalize(worldFromLocal * way);
    part = visiblePart(way);
#ifdef OPAQUE_IN_FRONT
    float depth = texelFetch(opaqueDepth, ivec2(gl_FragCoord.xy), 0).r;
    if (depth > 0.0 && nearDistance / depth < part.end) {
        part.end = nearDistance / depth;
        part.endAxis = -1;
    }
#endif
    entry = part.begin;
    last = part.end - part.begin;
    start = eye.xyz + entry * way;
}

vec3 indexOnRay(float t) {
    vec3 p = start + t * way;
    cell = cellAt(p, cell);
    vec3 index = clamp(indexAt(p, cell), vec3(0.0), vec3(samples.xyz - 1));
    // On a face of the domain, not beside it by rounding: the samples there alone decide.
    if (t <= 0.0 && part.beginAxis >= 0) index[part.beginAxis] = roundEven(index[part.beginAxis]);
    if (t >= last && part.endAxis >= 0) index[part.endAxis] = roundEven(index[part.endAxis]);
    return index;
}

// Where the ray leaves a brick.
float brickEnd(ivec3 brick) {
    float end = 3e38;
    for (int k = 0; k < 3; ++k) {
        if (way[k] == 0.0) continue;
        int side = way[k] > 0.0 ? min((brick[k] + 1) * kBrickCells, samples[k] - 1) : brick[k] * kBrickCells;
        end = min(end, (coordinateOf(k, side) - start[k]) / way[k]);
    }
    return end;
}
