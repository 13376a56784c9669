#version 450 core
#include "lib/lighting.glsl"
#include "lib/volume.glsl"

// Z. Nagy and R. Klein, "Depth-Peeling for Texture-Based Volume Rendering", 2003: the crossings of an
// iso-value along the ray are the layers, counted in one traversal whatever their number. A layer is passed
// where the sign of value - iso changes; the first sample, and the first one after missing ones, sets the sign.

in vec2 clipPlace;
layout(location = 0) out vec4 opaqueColor;

#ifdef OPAQUE_IN_FRONT
layout(binding = 1) uniform sampler2D opaqueDepth;
#endif

const int kComposed = 2;
const int kSilhouettes = 3;
const int kRefinements = 5;
// Of a step, down to where values end.
const int kBorderHalvings = 8;
// Less than that no 8-bit picture shows.
const float kOpaqueEnough = 1.0 / 1024.0;
// Of a step, so that rounding does not stay in the brick.
const float kNudge = 1e-3;
// More than any volume has on a ray; without a bound a camera of NaNs would never end.
const int kMostLooks = 1 << 18;

vec3 start = vec3(0.0);  // where the ray enters, local: what is far away is measured from there
vec3 way = vec3(0.0);    // of the ray, local; t counts from the start
vec3 toEye = vec3(0.0);  // in the world, length 1
ivec3 cell = ivec3(0);
RayPart part = kNoPart;
float last = 0.0;        // t of the ray's end
float entry = 0.0;       // distance of the start along the view axis
int layer = 0;           // met so far
int counted = 0;         // of them in the picture
vec3 color = vec3(0.0);  // times opacity
float transmittance = 1.0;
float wantedDepth = 0.0;

vec3 indexOnRay(float t) {
    vec3 p = start + t * way;
    cell = cellAt(p, cell);
    vec3 index = clamp(indexAt(p, cell), vec3(0.0), vec3(samples.xyz - 1));
    // On a face of the domain, not beside it by rounding: the samples there alone decide.
    if (t <= 0.0 && part.beginAxis >= 0) index[part.beginAxis] = roundEven(index[part.beginAxis]);
    if (t >= last && part.endAxis >= 0) index[part.endAxis] = roundEven(index[part.endAxis]);
    return index;
}

// Between two samples on either side of the iso-value: the rule of false position, halving the end that
// stays (Illinois).
float crossing(float t0, float t1) {
    float f0 = valueAt(indexOnRay(t0)) - iso;
    float f1 = valueAt(indexOnRay(t1)) - iso;
    int kept = 0;
    for (int i = 0; i < kRefinements; ++i) {
        float t = t0 + (t1 - t0) * clamp(f0 / (f0 - f1), 0.0, 1.0);
        float f = valueAt(indexOnRay(t)) - iso;
        if (isnan(f)) return t;
        if ((f >= 0.0) == (f1 >= 0.0)) {
            t1 = t;
            f1 = f;
            if (kept == 1) f0 *= 0.5;
            kept = 1;
        } else {
            t0 = t;
            f0 = f;
            if (kept == -1) f1 *= 0.5;
            kept = -1;
        }
    }
    return t0 + (t1 - t0) * clamp(f0 / (f0 - f1), 0.0, 1.0);
}

// Where values end between a sample that has one and a sample that has none.
float border(float present, float missing) {
    for (int i = 0; i < kBorderHalvings; ++i) {
        float t = 0.5 * (present + missing);
        if (isnan(valueAt(indexOnRay(t)))) {
            missing = t;
        } else {
            present = t;
        }
    }
    return present;
}

float cosineAt(vec3 index) {
    vec3 normal = normalFromLocal * gradientAt(index);
    float length = length(normal);
    return length > 0.0 ? min(abs(dot(normal, toEye)) / length, 1.0) : 0.0;
}

// True where nothing behind this layer matters.
bool passLayer(float t) {
    ++layer;
    if (layer > layersWanted) return true;
    if (layer < firstLayer) return false;
    if ((show == kComposed || show == kSilhouettes) && transmittance <= kOpaqueEnough) return true;
    vec4 own = layerColors[layer - 1];
    float cosine = cosineAt(indexOnRay(t));
    if (layer == layersWanted) wantedDepth = entry + t;
    if (show == kSilhouettes) {
        if (cosine >= silhouette) return layer == layersWanted;
        if (transmittance > 0.0) color = own.rgb;
        transmittance = 0.0;
        return true;
    }
    vec3 lit = litColor(own.rgb, cosine);
    ++counted;
    if (show == kComposed) {
        color += transmittance * own.a * lit;
        transmittance *= 1.0 - own.a;
        return layer == layersWanted || transmittance <= kOpaqueEnough;
    }
    color = mix(color, lit, 1.0 / float(counted));
    transmittance = 0.0;
    return layer == layersWanted;
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

// Samples lie at even steps where the axes are even, whichever bricks are left out; the last one lies at
// the end.
void traverse() {
    bool known = false;
    bool inside = false;
    float tBefore = 0.0;
    float t = 0.0;
    int i = 0;
    ivec3 brick = ivec3(-1);
    vec2 range = vec2(0.0);
    for (int looks = 0; looks < kMostLooks; ++looks) {
        vec3 index = indexOnRay(t);
        if (cell / kBrickCells != brick) {
            brick = cell / kBrickCells;
            range = rangeOf(brick);
        }
        // On one side of the iso-value, or without values: the brick's range tells the sample's side.
        bool leftOut = range.x > range.y || range.y < iso || range.x >= iso;
        bool valid = range.x <= range.y;
        bool now = range.x >= iso;
        if (!leftOut) {
            float value = valueAt(index);
            valid = !isnan(value);
            now = value >= iso;
        }
        // A layer reaches as far as values do.
        float from = tBefore;
        float to = t;
        if (known && !valid) {
            to = border(tBefore, t);
            now = valueAt(indexOnRay(to)) >= iso;
        } else if (!known && valid && tBefore < t) {
            from = border(t, tBefore);
            inside = valueAt(indexOnRay(from)) >= iso;
            known = true;
        }
        if (known && now != inside) {
            bool ends = passLayer(crossing(from, to));
#ifndef WHOLE_RAY
            if (ends) return;
#endif
        }
        if (t >= last) return;
        known = valid;
        inside = now;
        float dt = stepCells / length(way / cellWidth(cell));
        tBefore = t;
        if (leftOut) {
            // Up to the brick's end nothing changes.
            float end = max(brickEnd(brick), t);
            if (end >= last) return;
#ifdef UNEVEN_AXES
            tBefore = end;
            t = end + kNudge * dt;
#else
            i = max(i + 1, int(ceil(end / dt)));
            tBefore = float(i - 1) * dt;
            t = float(i) * dt;
#endif
        } else {
#ifdef UNEVEN_AXES
            t += dt;
#else
            t = float(++i) * dt;
#endif
        }
        t = min(t, last);
    }
}

void main() {
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
    if (last > 0.0) traverse();
#ifdef MEASURE
    opaqueColor = vec4(wantedDepth, float(layer), 0.0, 1.0);
#else
    opaqueColor = vec4(color, 1.0 - transmittance);
#endif
}
