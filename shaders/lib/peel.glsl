// Unit of the depth of the layer before; the first layer has none.
#ifdef PREVIOUS_LAYER
layout(binding = PREVIOUS_LAYER) uniform sampler2D previousDepth;

bool isPeeled() { return gl_FragCoord.z >= texelFetch(previousDepth, ivec2(gl_FragCoord.xy), 0).r; }
#else
bool isPeeled() { return false; }
#endif
