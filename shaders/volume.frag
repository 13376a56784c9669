#version 450 core
#include "lib/lighting.glsl"
#include "lib/volume_ray.glsl"

// Emission and absorption (D. Weiskopf, K. Engel and T. Ertl, "Interactive Clipping Techniques for Texture-Based Volume
// Visualization and Volume Shading", 2003, equations 8 and 9): a step lets through the power of its length of what a
// unit lets through, and sends light in proportion to what it absorbs.

layout(location = 0) out vec4 opaqueColor;

layout(binding = 21) uniform sampler2D transfer;       // color, opacity of a unit
layout(binding = 22) uniform sampler2D visibleRanges;  // row a, column b: any opacity in the bins a to b

const int kBins = 64;

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

// A flat place sends its light everywhere.
vec3 lightOf(vec3 color, vec3 index) {
    if (litByGradient == 0) return color;
    vec3 normal = normalFromLocal * gradientAt(index);
    float length = length(normal);
    return litColor(color, length > 0.0 ? min(abs(dot(normal, toEye)) / length, 1.0) : 1.0);
}

void main() {
    beginRay();
    vec3 color = vec3(0.0);
    float transmittance = 1.0;
    float unitsPerT = perUnit * length(worldFromLocal * way);
    float t = 0.0;
    int i = 0;
    ivec3 brick = ivec3(-1);
    bool visible = false;
    for (int looks = 0; looks < kMostLooks && t < last; ++looks) {
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
            float through = pow(1.0 - medium.a, (end - t) * unitsPerT);
            color += transmittance * (1.0 - through) * lightOf(medium.rgb, index);
            transmittance *= through;
            if (transmittance <= kOpaqueEnough) break;
        }
#ifdef UNEVEN_AXES
        t = end;
#else
        t = float(++i) * dt;
#endif
    }
    opaqueColor = vec4(color, 1.0 - transmittance);
}
