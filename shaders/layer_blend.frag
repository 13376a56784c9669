#version 450 core

layout(binding = 4) uniform sampler2D layerColor;

layout(location = 0) out vec4 composed;

void main() { composed = texelFetch(layerColor, ivec2(gl_FragCoord.xy), 0); }
