// Puts a point on the screen, for the last stage before the rasterizer.

layout(location = 14) uniform vec2 shift;         // of the whole picture, clip space, for one sample of several
layout(location = 9) uniform float nearFraction;  // depth = nearFraction / w, reversed

invariant gl_Position;

// Corners go to the rasterizer's grid here, for it draws triangles with corners on that but interpolates between those it
// is given: beside one that is seen edge-on and thinner than the grid is fine, it would show a point far outside it.
const float GRID_LINES_PER_PX = 256.0;

// Where the map repeats, the nearest of its positions to `reference`, which every corner of a part shares.
void landNear(vec3 at, vec2 reference) {
    vec3 h = screenPosition(at);
#ifdef PROJECTIVE
    gl_Position = vec4(2.0 * h.xy / size.xy - h.z + shift * h.z, nearFraction, h.z);
#else
    precise vec2 px = h.xy / h.z;
    if (size.z > 0.0) px.x += size.z * round((reference.x - px.x) / size.z);
    if (size.w > 0.0) px.y += size.w * round((reference.y - px.y) / size.w);
    px += 0.5 * shift * size.xy;
    px = round(px * GRID_LINES_PER_PX) / GRID_LINES_PER_PX;
    precise vec2 inClip = (2.0 * px / size.xy - 1.0) * h.z;
    gl_Position = vec4(inClip, nearFraction, h.z);
#endif
}
