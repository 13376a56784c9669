#version 450 core
#include "lib/position.glsl"

void main() { placeVertex(); }
