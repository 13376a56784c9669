#version 450 core
#include "lib/lighting.glsl"
#include "lib/volume_ray.glsl"
#ifdef CUT_LIGHT
#include "lib/cut_light.glsl"
#endif

// Emission and absorption (D. Weiskopf, K. Engel and T. Ertl, "Interactive Clipping Techniques for Texture-Based Volume
// Visualization and Volume Shading", 2003, equations 8 and 9): a step lets through the power of its length of what a
// unit lets through, and sends light in proportion to what it absorbs.

layout(location = 0) out vec4 opaqueColor;

layout(binding = 21) uniform sampler2D transfer;       // color, opacity of a unit
layout(binding = 22) uniform sampler2D visibleRanges;  // row a, column b: any opacity in the bins a to b

const int kBins = 64;

vec3 color = vec3(0.0);  // times opacity
float transmittance = 1.0;

// Of a value, 0 to the last entry.
float entryOf(float value) {
    return clamp((value - transferLow) * transferScale, 0.0, float(textureSize(transfer, 0).x - 1));
}

// Not by the sampler, whose weights may have 8 bits.
vec4 transferred(float value) {
    float entry = entryOf(value);
    int low = min(int(entry), textureSize(transfer, 0).x - 2);
    return mix(texelFetch(transfer, ivec2(low, 0), 0), texelFetch(transfer, ivec2(low + 1, 0), 0), entry - float(low));
}

bool isVisible(vec2 range) {
    if (range.x > range.y) return false;
    float perBin = float(textureSize(transfer, 0).x - 1) / float(kBins);
    ivec2 bins = clamp(ivec2(floor(vec2(entryOf(range.x), entryOf(range.y)) / perBin)), 0, kBins - 1);
    return texelFetch(visibleRanges, bins.yx, 0).r > 0.0;
}

// What a way of so many units takes away, 1 - (1 - a)^units, from the opacity of one: by series where differences from
// 1 would be rounded away; what they leave out is below 2^-28 of it.
float absorbed(float a, float units) {
    if (a >= 1.0) return 1.0;
    const float kSmall = 1.0 / 128.0;
    float d = units * (a < kSmall ? a * (1.0 + a * (1.0 / 2.0 + a * (1.0 / 3.0 + a / 4.0))) : -log(1.0 - a));
    return d < kSmall ? d * (1.0 - d * (1.0 / 2.0 - d * (1.0 / 6.0 - d / 24.0))) : 1.0 - exp(-d);
}

// A flat place sends its light everywhere. Near a cut the cut's own light takes a share (section 5.2).
vec3 lightOf(vec3 own, vec3 index, float t) {
    if (litByGradient == 0) return own;
    vec3 normal = normalFromLocal * gradientAt(index);
    float length = length(normal);
    vec3 light = litColor(own, length > 0.0 ? min(abs(dot(normal, toEye)) / length, 1.0) : 1.0);
#ifdef CUT_LIGHT
    Cut cut = nearestCut(start + t * way);
    light += cutWeightAt(cut.distance) * (litColor(own, min(abs(dot(cut.normal, toEye)), 1.0)) - light);
#endif
    return light;
}

// Through one part of the ray.
void traverse() {
    float unitsPerT = perUnit * length(worldFromLocal * way);
    float t = 0.0;
    int i = 0;
    int most = mostLooks();
    ivec3 brick = ivec3(-1);
    bool visible = false;
    for (int looks = 0; looks < most && t < last; ++looks) {
        cell = cellAt(start + t * way, cell);
        float dt = stepCells / length(way / cellWidth(cell));
        float end = min(t + dt, last);
        vec3 index = indexOnRay(0.5 * (t + end));
        if (cell / kBrickCells != brick) {
            brick = cell / kBrickCells;
            visible = isVisible(rangeOf(brick));
        }
        if (!visible) {
            float brickLast = brickEnd(brick);
#ifdef UNEVEN_AXES
            t = max(brickLast, end) + kNudge * dt;
#else
            // To the first step whose middle lies beyond.
            i = max(i + 1, int(ceil(brickLast / dt - 0.5)));
            t = float(i) * dt;
#endif
            continue;
        }
        float value = valueAt(index);
        vec4 medium = isnan(value) ? vec4(0.0) : transferred(value);
        if (medium.a > 0.0) {
            float taken = absorbed(medium.a, (end - t) * unitsPerT);
            color += transmittance * taken * lightOf(medium.rgb, index, 0.5 * (t + end));
            transmittance *= 1.0 - taken;
            if (transmittance <= opaqueEnough()) return;
        }
#ifdef UNEVEN_AXES
        t = end;
#else
        t = float(++i) * dt;
#endif
    }
}

void main() {
    beginRay();
    do {
        traverse();
    } while (transmittance > opaqueEnough() && nextPart());
    opaqueColor = vec4(color, 1.0 - transmittance);
}
