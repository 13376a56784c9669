// One volume between two key frames, along the ray of a pixel. Positions are "local": series coordinates from
// the middle of the volume, with the axes turned so that they grow with the index. Mirrored by VolumeUniforms.
layout(std140, binding = 3) uniform Volume {
    vec4 eye;                // local
    vec4 forward;            // local; a pixel at (x, y) of clip space looks along forward + x right + y up
    vec4 right;
    vec4 up;
    vec4 boxLow;             // the domain
    vec4 boxHigh;
    vec4 indexPerUnit;       // even axes: index = (p - boxLow) * indexPerUnit
    mat3 worldFromLocal;     // directions
    mat3 normalFromLocal;    // gradients, up to a factor
    vec4 planes[16];         // local; keep a x + b y + c z + d >= 0, a distance in the world
    ivec4 samples;           // along x, y, z
    vec2 shift;              // of the pixel's sample in clip space
    float fraction;          // of the time between the key frames
    float iso;
    float stepCells;         // between samples, in cells
    float nearDistance;      // depth is nearDistance / distance along the view axis
    int planeCount;
    int layersWanted;
    vec4 layerColors[16];    // linear color, opacity
    int show;                // LayerStyle::Show
    float silhouette;
    int firstLayer;          // before it layers only count
    float transferLow;       // value of the first entry of the transfer function
    float transferScale;     // its entries a value
    float perUnit;           // one over the world length that its opacities are meant for
    int litByGradient;
    int solidCount;
    ivec4 solids[8];         // SolidShape, Keep
    vec4 solidRows[24];      // three a solid: its coordinate k of p is dot(row k, vec4(p, 1))
    vec4 solidGradients[24]; // in the world, of those coordinates
    vec4 planeNormals[16];   // in the world, of length 1
    float cutThickness;      // world
    int cutWeight;           // CutLight::Weight
};

layout(binding = 16) uniform sampler3D valuesA;
layout(binding = 18) uniform sampler3D rangesA;
#ifdef TWO_KEY_FRAMES
layout(binding = 17) uniform sampler3D valuesB;
layout(binding = 19) uniform sampler3D rangesB;
#endif
#ifdef UNEVEN_AXES
layout(binding = 20) uniform sampler2D axisTables;  // row k: local coordinates of the samples along axis k
#endif

const int kBrickCells = 8;

// NaN next to missing samples.
float valueAt(vec3 index) {
    vec3 place = (index + 0.5) / vec3(samples.xyz);
    float value = texture(valuesA, place).r;
#ifdef TWO_KEY_FRAMES
    // Exact where both are equal, unlike mix(): rounding must not decide on which side a plateau lies.
    value += fraction * (texture(valuesB, place).r - value);
#endif
    return value;
}

// Smallest and largest value in a brick; inf, -inf where there are none, -inf, inf where they are not known.
vec2 rangeOf(ivec3 brick) {
    vec2 range = texelFetch(rangesA, brick, 0).rg;
#ifdef TWO_KEY_FRAMES
    vec2 next = texelFetch(rangesB, brick, 0).rg;
    // Where one key frame has no values there are none between them.
    if (range.x > range.y || next.x > next.y) return range.x > range.y ? range : next;
    range = vec2(min(range.x, next.x), max(range.y, next.y));
#endif
    return range;
}

float coordinateOf(int axis, int i) {
#ifdef UNEVEN_AXES
    return texelFetch(axisTables, ivec2(i, axis), 0).r;
#else
    return boxLow[axis] + float(i) / indexPerUnit[axis];
#endif
}

// The cell that holds a position, from a cell that is not far away.
ivec3 cellAt(vec3 p, ivec3 cell) {
#ifdef UNEVEN_AXES
    for (int k = 0; k < 3; ++k) {
        while (cell[k] < samples[k] - 2 && p[k] >= coordinateOf(k, cell[k] + 1)) ++cell[k];
        while (cell[k] > 0 && p[k] < coordinateOf(k, cell[k])) --cell[k];
    }
    return cell;
#else
    return clamp(ivec3((p - boxLow.xyz) * indexPerUnit.xyz), ivec3(0), samples.xyz - 2);
#endif
}

vec3 cellWidth(ivec3 cell) {
#ifdef UNEVEN_AXES
    vec3 width;
    for (int k = 0; k < 3; ++k) width[k] = coordinateOf(k, cell[k] + 1) - coordinateOf(k, cell[k]);
    return width;
#else
    return 1.0 / indexPerUnit.xyz;
#endif
}

vec3 indexAt(vec3 p, ivec3 cell) {
#ifdef UNEVEN_AXES
    vec3 index;
    for (int k = 0; k < 3; ++k) {
        float low = coordinateOf(k, cell[k]);
        index[k] = float(cell[k]) + (p[k] - low) / (coordinateOf(k, cell[k] + 1) - low);
    }
    return index;
#else
    return (p - boxLow.xyz) * indexPerUnit.xyz;
#endif
}

// Local coordinate of a place between samples.
float coordinateAt(int axis, float index) {
    int low = clamp(int(index), 0, samples[axis] - 2);
    float first = coordinateOf(axis, low);
    return first + (index - float(low)) * (coordinateOf(axis, low + 1) - first);
}

// Central differences over a sample either way, one-sided at the border and beside missing samples.
vec3 gradientAt(vec3 index) {
    float here = valueAt(index);
    vec3 gradient = vec3(0.0);
    for (int k = 0; k < 3; ++k) {
        vec3 before = index;
        vec3 after = index;
        before[k] = max(index[k] - 1.0, 0.0);
        after[k] = min(index[k] + 1.0, float(samples[k] - 1));
        float low = valueAt(before);
        float high = valueAt(after);
        if (isnan(low)) {
            low = here;
            before[k] = index[k];
        }
        if (isnan(high)) {
            high = here;
            after[k] = index[k];
        }
        float way = coordinateAt(k, after[k]) - coordinateAt(k, before[k]);
        if (way > 0.0) gradient[k] = (high - low) / way;
    }
    return gradient;
}

// The part of a ray that the box and the planes leave.
struct RayPart {
    float begin, end;          // t of eye + t way; empty where begin > end
    int beginAxis, endAxis;    // of the face of the box that begins or ends it; -1 where none does
};

const RayPart kNoPart = RayPart(1.0, 0.0, -1, -1);

RayPart visiblePart(vec3 way) {
    RayPart part = RayPart(0.0, 3e38, -1, -1);
    for (int k = 0; k < 3; ++k) {
        if (way[k] == 0.0) {
            if (eye[k] < boxLow[k] || eye[k] > boxHigh[k]) return kNoPart;
            continue;
        }
        float a = (boxLow[k] - eye[k]) / way[k];
        float b = (boxHigh[k] - eye[k]) / way[k];
        if (min(a, b) > part.begin) {
            part.begin = min(a, b);
            part.beginAxis = k;
        }
        if (max(a, b) < part.end) {
            part.end = max(a, b);
            part.endAxis = k;
        }
    }
    for (int i = 0; i < planeCount; ++i) {
        float at = dot(planes[i].xyz, eye.xyz) + planes[i].w;
        float along = dot(planes[i].xyz, way);
        if (along == 0.0 && at < 0.0) return kNoPart;
        if (along > 0.0 && -at / along > part.begin) {
            part.begin = -at / along;
            part.beginAxis = -1;
        }
        if (along < 0.0 && -at / along < part.end) {
            part.end = -at / along;
            part.endAxis = -1;
        }
    }
    return part;
}
