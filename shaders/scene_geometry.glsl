// The scene's triangles as every stage reads them. Positions are metres relative to the scene's origin.

layout(std430, binding = 0) readonly buffer Positions { float positions[]; };
layout(std430, binding = 1) readonly buffer Corners { uint corners[]; };  // three vertex indices a triangle

const uint NO_PIECE = 0xffffffffu;

layout(location = 0) uniform mat3 wallFromScene;
layout(location = 1) uniform vec3 originFromEye;  // in scene axes; the difference was taken in double

// From the eye to a point of the scene, in wall axes.
vec3 rayTo(vec3 position) { return wallFromScene * (position + originFromEye); }

vec3 rayToVertex(uint vertex) {
    return rayTo(vec3(positions[3u * vertex], positions[3u * vertex + 1u], positions[3u * vertex + 2u]));
}
