#include "lib/draw.glsl"

// Opacity of a fragment of a semi-transparent surface, from 0 to 1. Every method takes it from here.
float fragmentOpacity() { return colorOpacity.a; }
