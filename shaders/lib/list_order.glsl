#include "lib/fragment_lists.glsl"

// Composes a list front to back ("over"): emission, and in alpha the transmittance of the nearest
// `limit` fragments. The result does not depend on the order in which the fragments were drawn: equal
// depths are ordered by what the fragments bring, and what is equal in that, too, may change places.

// Nearest nodes that one walk over the list collects.
const int kCollected = 8;
const float kBeforeAll = 2.0;  // nearer than any depth
const float kNone = -1.0;      // farther than any depth

vec4 blendedUnder(vec4 front, vec4 fragment) {
    return vec4(front.rgb + front.a * fragment.rgb, front.a * (1.0 - fragment.a));
}

vec4 contentOf(uint link) { return vec4(nodes[link - 1u].red, nodes[link - 1u].green, nodes[link - 1u].blue, nodes[link - 1u].opacity); }

// Lexicographic.
bool isLess(vec4 a, vec4 b) {
    for (int i = 0; i < 4; ++i) {
        if (a[i] != b[i]) return a[i] < b[i];
    }
    return false;
}

// For any list: each walk finds the fragment that comes after the last one, with all its equals.
vec4 composeTiedList(uint head, int limit) {
    vec4 front = vec4(0.0, 0.0, 0.0, 1.0);
    float depth = kBeforeAll;
    vec4 content = vec4(0.0);
    for (int left = limit; left > 0;) {
        float nextDepth = kNone;
        vec4 nextContent = vec4(0.0);
        int equals = 0;
        for (uint i = head; i != kEndOfList; i = nodes[i - 1u].next) {
            float d = nodes[i - 1u].depth;
            vec4 c = contentOf(i);
            if (d > depth || (d == depth && !isLess(content, c))) continue;
            if (d == nextDepth && c == nextContent) {
                ++equals;
            } else if (d > nextDepth || (d == nextDepth && isLess(c, nextContent))) {
                nextDepth = d;
                nextContent = c;
                equals = 1;
            }
        }
        if (equals == 0) break;
        for (int i = min(equals, left); i > 0; --i) front = blendedUnder(front, nextContent);
        left -= equals;
        depth = nextDepth;
        content = nextContent;
    }
    return front;
}

// Each walk collects the nearest fragments that are left, sorted by insertion. One more than is used
// tells whether the last one's depth is its alone.
vec4 composeList(uint head, int limit) {
    vec4 front = vec4(0.0, 0.0, 0.0, 1.0);
    bool tied = false;
    float last = kBeforeAll;
    for (int left = limit; head != kEndOfList && last >= 0.0 && left > 0 && !tied; left -= kCollected) {
        float depths[kCollected + 1];
        uint links[kCollected + 1];
        for (int k = 0; k <= kCollected; ++k) {
            depths[k] = kNone;
            links[k] = head;
        }
        for (uint i = head; i != kEndOfList; i = nodes[i - 1u].next) {
            float depth = nodes[i - 1u].depth < last ? nodes[i - 1u].depth : kNone;
            uint link = i;
            for (int k = 0; k <= kCollected; ++k) {
                bool nearer = depth > depths[k];
                float farDepth = nearer ? depths[k] : depth;
                uint farLink = nearer ? links[k] : link;
                depths[k] = nearer ? depth : depths[k];
                links[k] = nearer ? link : links[k];
                depth = farDepth;
                link = farLink;
            }
        }
        for (int k = 0; k < kCollected; ++k) {
            bool used = depths[k] >= 0.0 && k < left;
            tied = tied || (used && depths[k] == depths[k + 1]);
            if (used) front = blendedUnder(front, contentOf(links[k]));
        }
        last = depths[kCollected - 1];
    }
    if (tied) return composeTiedList(head, limit);
    return front;
}
