// How far a place is from the surfaces of what clips, and how they are turned, for the light of cuts.

const int kStep = 0;
const int kRamp = 1;

// The nearest surface so far.
struct Cut {
    float distance;  // in the world
    vec3 normal;     // in the world, length 1, to either side
};

// A solid is what lies below 1 in each of up to three coordinates that grow outwards: their distances from it, and
// their gradients, all in the world. Outside, distances along orthogonal gradients add up.
struct Sides {
    float over[3];
    vec3 outward[3];
    int count;
};

void addSide(inout Sides sides, float coordinate, vec3 gradient) {
    float slope = length(gradient);
    if (slope == 0.0) return;
    sides.over[sides.count] = (coordinate - 1.0) / slope;
    sides.outward[sides.count] = gradient / slope;
    ++sides.count;
}

// Of the distance from the axis, or from the middle.
void addRound(inout Sides sides, int i, vec3 p) {
    float radius = length(p);
    vec3 along = radius > 0.0 ? p / radius : vec3(1.0, 0.0, 0.0);
    addSide(sides, radius, along.x * solidGradients[3 * i].xyz + along.y * solidGradients[3 * i + 1].xyz +
                               along.z * solidGradients[3 * i + 2].xyz);
}

Cut surfaceOfSolid(int i, vec3 place) {
    vec3 p = inSolid(i, vec4(place, 1.0));
    Sides sides;
    sides.count = 0;
    int shape = solids[i].x;
    int firstFlat = shape == kBox ? 0 : 2;
    if (shape == kSphere) {
        addRound(sides, i, p);
    } else {
        if (shape != kBox) addRound(sides, i, vec3(p.xy, 0.0));
        for (int k = firstFlat; k < 3; ++k)
            addSide(sides, abs(p[k]), (p[k] < 0.0 ? -1.0 : 1.0) * solidGradients[3 * i + k].xyz);
    }
    Cut nearest = Cut(3e38, vec3(0.0));
    vec3 outside = vec3(0.0);
    for (int k = 0; k < sides.count; ++k) {
        outside += max(sides.over[k], 0.0) * sides.outward[k];
        if (abs(sides.over[k]) < nearest.distance) nearest = Cut(abs(sides.over[k]), sides.outward[k]);
    }
    float far = length(outside);
    return far > 0.0 ? Cut(far, outside / far) : nearest;
}

Cut nearestCut(vec3 place) {
    Cut nearest = Cut(3e38, vec3(0.0));
    for (int i = 0; i < planeCount; ++i) {
        float distance = abs(dot(planes[i].xyz, place) + planes[i].w);
        if (distance < nearest.distance) nearest = Cut(distance, planeNormals[i].xyz);
    }
    for (int i = 0; i < solidCount; ++i) {
        Cut cut = surfaceOfSolid(i, place);
        if (cut.distance < nearest.distance) nearest = cut;
    }
    return nearest;
}

float cutWeightAt(float distance) {
    if (distance >= cutThickness) return 0.0;
    if (cutWeight == kStep) return 1.0;
    float part = distance / cutThickness;
    return cutWeight == kRamp ? 1.0 - part : 1.0 - part * part * (3.0 - 2.0 * part);
}
