#version 450 core

out vec2 clipPlace;

// One triangle that covers the screen: (-1,-1), (3,-1), (-1,3).
void main() {
    clipPlace = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
    gl_Position = vec4(clipPlace, 0.5, 1.0);
}
