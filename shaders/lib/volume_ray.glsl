#include "lib/volume.glsl"
#include "lib/solids.glsl"

// The ray of a pixel through the volume; `clipPlace` is that of the full-screen triangle.
in vec2 clipPlace;

#ifdef OPAQUE_IN_FRONT
layout(binding = 1) uniform sampler2D opaqueDepth;
#endif

// Of a step, so that rounding does not stay in the brick.
const float kNudge = 1e-3;

vec3 start = vec3(0.0);  // where a part of the ray begins, local: what is far away is measured from there
vec3 way = vec3(0.0);    // of the ray, local; t counts from the start
vec3 toEye = vec3(0.0);  // in the world, length 1
ivec3 cell = ivec3(0);
RayPart part = kNoPart;
float last = 0.0;        // t of the part's end
float entry = 0.0;       // distance of the start along the view axis

#ifdef SOLIDS
RayPart whole = kNoPart;  // what planes and probing leave; `part` is the next one of it that nothing cuts away
vec2 cuts[8];             // t of eye + t way, where cutting takes something away
int cutCount = 0;

// Probing shortens the ray, cutting takes a part out of it.
void clipBySolids() {
    if (whole.begin >= whole.end) return;
    float from = whole.begin;
    vec3 place = eye.xyz + from * way;
    for (int i = 0; i < solidCount; ++i) {
        vec2 inside = from + partInSolid(i, place, way);
        if (solids[i].y == kKeepOutside) {
            if (inside.x < inside.y) cuts[cutCount++] = inside;
            continue;
        }
        if (inside.x > whole.begin) {
            whole.begin = inside.x;
            whole.beginAxis = -1;
        }
        if (inside.y < whole.end) {
            whole.end = inside.y;
            whole.endAxis = -1;
        }
    }
}

// From `begin` to the first cut, behind the cuts that hold `begin`.
RayPart nextUncut(float begin, int beginAxis) {
    RayPart next = RayPart(begin, whole.end, beginAxis, whole.endAxis);
    // Each cut moves the beginning once at most, but in any order.
    for (int round = 0; round < cutCount; ++round) {
        for (int i = 0; i < cutCount; ++i) {
            if (cuts[i].x <= next.begin && next.begin < cuts[i].y) {
                next.begin = cuts[i].y;
                next.beginAxis = -1;
            }
        }
    }
    for (int i = 0; i < cutCount; ++i) {
        if (cuts[i].x > next.begin && cuts[i].x < next.end) {
            next.end = cuts[i].x;
            next.endAxis = -1;
        }
    }
    return next;
}
#endif

// A ray meets at most as many cells as the axes have together, and is at most the root of 3 cells long in each.
// Without a bound a camera of NaNs would never end.
int mostLooks() {
    return int(float(samples.x + samples.y + samples.z) * (2.0 / stepCells + 3.0));
}

// What comes through then is less than half a step of 8 bits: of a picture whose light is scaled by the exposure,
// and whose curve is steepest, 12.92, in the dark.
float opaqueEnough() {
    return 0.5 / (255.0 * 12.92) / max(exposure, 1.0);
}

void beginPart(RayPart next) {
    part = next;
    entry = part.begin;
    last = part.end - part.begin;
    start = eye.xyz + entry * way;
}

// `last` is 0 or below where nothing is visible.
void beginRay() {
    vec2 clip = clipPlace - shift;
    way = forward.xyz + clip.x * right.xyz + clip.y * up.xyz;
    toEye = -normalize(worldFromLocal * way);
    RayPart visible = visiblePart(way);
#ifdef OPAQUE_IN_FRONT
    float depth = texelFetch(opaqueDepth, ivec2(gl_FragCoord.xy), 0).r;
    if (depth > 0.0 && nearDistance / depth < visible.end) {
        visible.end = nearDistance / depth;
        visible.endAxis = -1;
    }
#endif
#ifdef SOLIDS
    whole = visible;
    clipBySolids();
    beginPart(nextUncut(whole.begin, whole.beginAxis));
#else
    beginPart(visible);
#endif
}

// Goes on behind what is cut away; false where nothing follows.
bool nextPart() {
#ifdef SOLIDS
    if (part.end >= whole.end) return false;
    beginPart(nextUncut(part.end, -1));
    return last > 0.0;
#else
    return false;
#endif
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
