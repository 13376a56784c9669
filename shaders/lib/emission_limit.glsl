// The 4-pass method shows no emission beyond the nearest back face. The depth of that face was written
// by the same vertex code, so it equals that of its own fragment here, which emits.
#ifdef CUT_EMISSION
layout(binding = 3) uniform sampler2D nearestBackDepth;

bool emits() { return gl_FragCoord.z >= texelFetch(nearestBackDepth, ivec2(gl_FragCoord.xy), 0).r; }
#else
bool emits() { return true; }
#endif
