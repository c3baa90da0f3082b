// Where a display shows what lies along a ray, once a kind of map: one of PROJECTIVE, STEREOGRAPHIC, RADIAL (with
// RADIAL_MODEL), CYLINDER, EQUIRECTANGULAR, SPHERE_SLICES, PINHOLE and TABLE is defined; ON_SPHERE as well where a lens
// throws its picture on a dome. Beyond what a formula is good for, positions go on outwards, beside what is shown.

#include "screen_map.glsl"

#define real float
#define real2 vec2
#define real3 vec3
#define real4 vec4
#define real3x3 mat3

#ifdef ON_SPHERE
#include "root_ahead.glsl"
#include "sphere.glsl"
#endif
#ifdef CYLINDER
#include "root_ahead.glsl"
#include "cylinder.glsl"
#endif
#ifdef EQUIRECTANGULAR
#include "equirectangular.glsl"
#endif
#ifdef SPHERE_SLICES
#include "sphere_slices.glsl"
#endif
#ifdef RADIAL
#include "radial.glsl"
#endif
#ifdef PINHOLE
#include "pinhole.glsl"
#endif
#ifdef TABLE
layout(binding = 2) uniform sampler2D positionTable;
#endif

const float HALF_PI = 1.57079633;

vec3 inDisplay(vec3 ray) {
    vec3 d = vec3(dot(displayFromWall[0].xyz, ray), dot(displayFromWall[1].xyz, ray), dot(displayFromWall[2].xyz, ray));
#ifdef ON_SPHERE
    d = eyeOnSurface.xyz + sphereDistance(eyeOnSurface.w, eyeOnSurface.xyz, d) * d - lensOnSurface.xyz;
#endif
    return d;
}

// The side of the axis, which is -z, that a direction lies on, and its angle off the axis.
vec3 sideAndAngle(vec3 d) {
    float offAxis = length(d.xy);
    return vec3(offAxis > 0.0 ? d.xy / offAxis : vec2(1.0, 0.0), atan(offAxis, -d.z));
}

#ifdef STEREOGRAPHIC
// Oros, A conceptual and practical look into spherical curvilinear projection, section 2: the mean of depth and distance
// takes the depth's place, then perspective. Only here: near straight behind it is so small that all would be cut.
vec2 formulaPosition(vec3 d) {
    // Straight behind, where every side is right, it is the right.
    if (dot(d.xy, d.xy) < 1e-14 * dot(d, d)) d.x = 1e-7 * length(d);
    // Behind the eye depth and distance would cancel.
    float off = dot(d.xy, d.xy), apart = length(d);
    return d.xy / (d.z <= 0.0 ? 0.5 * (apart - d.z) : 0.5 * off / (apart + d.z));
}
#endif

#ifdef RADIAL
vec2 formulaPosition(vec3 d) {
    float c[kRadialTerms];
    for (int i = 0; i < kRadialTerms; ++i) c[i] = terms[i / 4][i % 4];
    vec3 off = sideAndAngle(d);
    if (off.z > limit.x) return off.xy * (limit.y + (off.z - limit.x) * limit.z);
    return radialPosition(RADIAL_MODEL, c, d);
}
#endif

#ifdef CYLINDER
vec2 formulaPosition(vec3 d) {
    // Along the axis the wall is never met.
    if (dot(d.xz, d.xz) < 1e-12 * dot(d, d)) d.x = 1e-6 * length(d);
    return cylinderPosition(eyeOnSurface.xyz + cylinderDistance(eyeOnSurface.w, eyeOnSurface.xyz, d) * d);
}
#endif

#ifdef EQUIRECTANGULAR
vec2 formulaPosition(vec3 d) { return equirectangularAngles(d); }
#endif

#ifdef SPHERE_SLICES
vec2 formulaPosition(vec3 d) { return sphereSlicesAngles(d) - vec2(HALF_PI, 0.0); }
#endif

#ifdef PINHOLE
vec2 formulaPosition(vec3 d) {
    float k[kPinholeTerms];
    for (int i = 0; i < kPinholeTerms; ++i) k[i] = terms[i / 4][i % 4];
    vec3 off = sideAndAngle(vec3(d.x, -d.y, d.z));
    vec2 p = off.xy * (off.z < limit.x ? tan(off.z) : limit.y);
    vec2 beyond = off.xy * (max(off.z - limit.x, 0.0) * limit.z);
    mat3 rows = mat3(tilt[0].xyz, tilt[1].xyz, tilt[2].xyz);
    return pinholeTilted(transpose(rows), pinholeDistorted(k, p)).xy + beyond;
}
#endif

#ifdef TABLE
// Bilinear by hand: samplers know only 256 steps between texels.
vec2 tableAt(vec2 node) {
    vec2 corner = clamp(floor(node), vec2(0.0), vec2(textureSize(positionTable, 0) - 2));
    vec2 st = node - corner;
    ivec2 at = ivec2(corner);
    vec2 top = mix(texelFetch(positionTable, at, 0).xy, texelFetch(positionTable, at + ivec2(1, 0), 0).xy, st.x);
    vec2 bottom =
        mix(texelFetch(positionTable, at + ivec2(0, 1), 0).xy, texelFetch(positionTable, at + ivec2(1, 1), 0).xy, st.x);
    return mix(top, bottom, st.y);
}

// The chart is the base plane one unit ahead (PLANE_CHART), or has every direction at its angle off the axis.
vec2 formulaPosition(vec3 d) {
    vec3 off = sideAndAngle(d);
#ifdef PLANE_CHART
    float radius = off.z < limit.x ? tan(off.z) : limit.y + (off.z - limit.x) * limit.z;
#else
    float radius = off.z;
#endif
    vec2 node = (off.xy * radius - tableBox.xy) * tableBox.zw;
    vec2 inside = clamp(node, vec2(0.0), vec2(textureSize(positionTable, 0) - 1));
    vec2 beside = (node - inside) / tableBox.zw;
    return tableAt(inside) + beside.x * beyondTable.xy + beside.y * beyondTable.zw;
}
#endif

// Homogeneous: xy / z are pixels, and z, the depth or the distance in distances to the wall, is positive for all that
// can be shown.
vec3 screenPosition(vec3 ray) {
    vec3 d = inDisplay(ray);
#ifdef PROJECTIVE
    return d;
#else
    return vec3(pixels.xy + pixels.zw * formulaPosition(d), 1.0) * (length(ray) * finish.x);
#endif
}
