// Per-pixel lists of fragments; mirrored by FragmentLists. A texture holds for each pixel a link to its
// first node. Link i leads to nodes[i - 1]; the end is 0, which is also what a lane without a pixel of
// its own reads (Mesa's llvmpipe goes on with such lanes, and would follow any other value for ever).
struct Node {
    float red, green, blue, opacity;  // emitted light and opacity
    float depth;
    uint next;  // link
};

layout(std430, binding = 0) buffer FragmentLists {
    uint nodeCount;  // goes on counting where there is no room
    uint nodeCapacity;
    Node nodes[];
};

const uint kEndOfList = 0u;
