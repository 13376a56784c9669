#version 450 core
#include "lib/present.glsl"

layout(binding = 9) uniform sampler2D linearImage;

layout(location = 0) out vec4 image;

void main() {
    image = presented(texelFetch(linearImage, ivec2(gl_FragCoord.xy), 0) * accumulationShare);
}
