// The tessellation engine's patches are triangles of the scene, by number.

layout(location = 0) flat out uint triangle;

void main() { triangle = uint(gl_VertexID); }
