#version 450 core
#include "lib/lighting.glsl"
#include "lib/volume_ray.glsl"

// Z. Nagy and R. Klein, "Depth-Peeling for Texture-Based Volume Rendering", 2003: the crossings of an
// iso-value along the ray are the layers, counted in one traversal whatever their number. A layer is passed
// where the sign of value - iso changes; the first sample, and the first one after missing ones, sets the sign.

layout(location = 0) out vec4 opaqueColor;

const int kComposed = 2;
const int kSilhouettes = 3;
const int kRefinements = 5;
// Of a step, down to where values end.
const int kBorderHalvings = 8;

int layer = 0;           // met so far
int counted = 0;         // of them in the picture
vec3 color = vec3(0.0);  // times opacity
float transmittance = 1.0;
float wantedDepth = 0.0;

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
    if ((show == kComposed || show == kSilhouettes) && transmittance <= opaqueEnough()) return true;
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
        return layer == layersWanted || transmittance <= opaqueEnough();
    }
    color = mix(color, lit, 1.0 / float(counted));
    transmittance = 0.0;
    return layer == layersWanted;
}

// Samples lie at even steps where the axes are even, whichever bricks are left out; the last one lies at
// the end. Returns whether nothing behind matters.
bool traverse() {
    bool known = false;
    bool inside = false;
    float tBefore = 0.0;
    float t = 0.0;
    int i = 0;
    int most = mostLooks();
    ivec3 brick = ivec3(-1);
    vec2 range = vec2(0.0);
    for (int looks = 0; looks < most; ++looks) {
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
            if (ends) return true;
#endif
        }
        if (t >= last) return false;
        known = valid;
        inside = now;
        float dt = stepCells / length(way / cellWidth(cell));
        tBefore = t;
        if (leftOut) {
            // Up to the brick's end nothing changes.
            float end = max(brickEnd(brick), t);
            if (end >= last) return false;
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
    return false;
}

void main() {
    beginRay();
    if (last > 0.0) {
        while (!traverse() && nextPart()) {
        }
    }
#ifdef MEASURE
    opaqueColor = vec4(wantedDepth, float(layer), 0.0, 1.0);
#else
    opaqueColor = vec4(color, 1.0 - transmittance);
#endif
}
