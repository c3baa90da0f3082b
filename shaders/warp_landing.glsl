// Puts a point on the screen, for the last stage before the rasterizer.

layout(location = 14) uniform vec2 shift;         // of the whole picture, clip space, for one sample of several
layout(location = 9) uniform float nearFraction;  // depth = nearFraction / w, reversed

invariant gl_Position;

// Where the map repeats, the nearest of its positions to `reference`, which every corner of a part shares.
void landNear(vec3 at, vec2 reference) {
    vec3 h = screenPosition(at);
    if (size.z > 0.0 || size.w > 0.0) {
        precise vec2 px = h.xy / h.z;
        if (size.z > 0.0) px.x += size.z * round((reference.x - px.x) / size.z);
        if (size.w > 0.0) px.y += size.w * round((reference.y - px.y) / size.w);
        h.xy = px * h.z;
    }
    gl_Position = vec4(2.0 * h.xy / size.xy - h.z, nearFraction, h.z);
    gl_Position.xy += shift * gl_Position.w;
}
