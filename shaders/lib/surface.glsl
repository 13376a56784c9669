in Surface {
    vec3 normal;  // not normalised, so that it interpolates without popping
    vec3 toEye;
    float colorValue;  // NaN where there is none; of no meaning without colorByValue
} surface;

float largestComponent(vec3 v) { return max(max(abs(v.x), abs(v.y)), abs(v.z)); }

// Any finite length, also those whose square is no float. The null vector stays null.
vec3 direction(vec3 v) {
    float largest = largestComponent(v);
    return largest > 0.0 ? normalize(v / largest) : vec3(0.0);
}

// Of the side that is seen.
vec3 seenNormal() {
    vec3 normal = direction(surface.normal);
    if (normal == vec3(0.0)) return direction(surface.toEye);
    return gl_FrontFacing ? normal : -normal;
}

// Of the angle between view and normal, the same for both sides of the surface.
float cosineOfView() { return abs(dot(direction(surface.normal), direction(surface.toEye))); }
