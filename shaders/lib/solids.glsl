// Where rays meet the solids that clip a volume. All of them are convex: two boundaries a ray, in closed form, where
// rasterized boundaries would need passes and textures of depths.
const int kBox = 0;
const int kSphere = 1;
const int kKeepOutside = 1;
const vec2 kMissed = vec2(1.0, 0.0);

// Part of a ray where |coordinate| <= 1.
vec2 partInSlab(float place, float way) {
    if (way == 0.0) return abs(place) <= 1.0 ? vec2(-3e38, 3e38) : kMissed;
    vec2 ends = (vec2(-1.0, 1.0) - place) / way;
    return way > 0.0 ? ends : ends.yx;
}

// From the point of the ray that is nearest to the middle: the difference of the squares of large distances would be
// rounded.
vec2 partInBall(vec3 place, vec3 way) {
    float square = dot(way, way);
    if (square == 0.0) return dot(place, place) <= 1.0 ? vec2(-3e38, 3e38) : kMissed;
    float nearest = -dot(place, way) / square;
    vec3 off = place + nearest * way;
    float left = 1.0 - dot(off, off);
    if (left < 0.0) return kMissed;
    float reach = sqrt(left / square);
    return vec2(nearest - reach, nearest + reach);
}

// What is local in a solid's own coordinates.
vec3 inSolid(int i, vec4 local) {
    return vec3(dot(solidRows[3 * i], local), dot(solidRows[3 * i + 1], local), dot(solidRows[3 * i + 2], local));
}

// Part of the ray place + t way in a solid, all local; empty where begin >= end.
vec2 partInSolid(int i, vec3 place, vec3 way) {
    vec3 p = inSolid(i, vec4(place, 1.0));
    vec3 v = inSolid(i, vec4(way, 0.0));
    if (solids[i].x == kSphere) return partInBall(p, v);
    vec2 inside = partInSlab(p.z, v.z);
    vec2 other = vec2(-3e38, 3e38);
    if (solids[i].x == kBox) {
        vec2 x = partInSlab(p.x, v.x);
        vec2 y = partInSlab(p.y, v.y);
        other = vec2(max(x.x, y.x), min(x.y, y.y));
        if (x.x > x.y || y.x > y.y) return kMissed;
    } else {
        other = partInBall(vec3(p.xy, 0.0), vec3(v.xy, 0.0));
    }
    if (inside.x > inside.y || other.x > other.y) return kMissed;
    return vec2(max(inside.x, other.x), min(inside.y, other.y));
}
