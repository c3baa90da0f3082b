// Where the ray of a pixel, or of a sample, meets a triangle, if it does: the test of Moeller and Trumbore (Fast, Minimum
// Storage Ray/Triangle Intersection, 1997) from the eye, by the planes through it and the triangle's edges.

#include "bounded_flags.glsl"
#include "surface.glsl"

layout(location = 0) flat in vec3 edgePlanes[3];  // edge i lies opposite corner i; what is inside is above all of them
layout(location = 3) flat in vec4 inverseDistance;  // along a ray of length one: dot(ray, xyz), at least w
layout(location = 4) flat in uvec4 vertices;  // and flags
#ifdef PARTED
layout(location = 5) flat in vec3 cut;
#endif
#ifdef EDGES
layout(location = 6) flat in vec3 edgeWidthsPx;
#endif
layout(std430, binding = 3) readonly buffer Normals { uint normals[]; };
layout(std430, binding = 4) readonly buffer Uvs { vec2 uvs[]; };

layout(binding = 1) uniform sampler2DArray rays;  // of the samples; see lens_rays.comp
layout(location = 9) uniform float nearFraction;
layout(location = 43) uniform mat3 wallFromLens;

layout(depth_less) out float gl_FragDepth;

vec3 heightsAbove(vec3 planes[3], vec3 ray) {
    precise vec3 heights;
    for (int i = 0; i < 3; ++i) heights[i] = planes[i].x * ray.x + planes[i].y * ray.y + planes[i].z * ray.z;
    return heights;
}

// A ray exactly in a plane belongs to one of its two sides: the one that the ray would be on a trifle further in x, or
// else in y or z. That moves the ray alike for all triangles, so that it is in one of those around a corner, too
// (Edelsbrunner and Muecke, Simulation of Simplicity, 1990).
bool isAbove(float height, vec3 plane) {
    if (height != 0.0) return height > 0.0;
    return plane.x != 0.0 ? plane.x > 0.0 : plane.y != 0.0 ? plane.y > 0.0 : plane.z > 0.0;
}

// Whether the shape is there for this ray.
bool isInPart(vec3 ray) {
    bool isIn = true;
#ifdef PARTED
    isIn = (dot(cut, ray) < 0.0) == ((vertices.w & BELOW_CUT) != 0u);
#endif
#ifdef WIDE
    isIn = isIn && (ray.z > 0.0) == ((vertices.w & BEHIND_THE_LENS) != 0u);
#endif
    return isIn;
}

// How the ray changes towards the next pixel, as the one before tells where the lens's picture ends.
vec3 changeOfRay(ivec3 texel, vec3 ray, ivec2 next) {
    ivec3 step = ivec3(next, 0), most = textureSize(rays, 0) - 1;
    vec4 after = texelFetch(rays, min(texel + step, most), 0);
    if (after.w != 0.0 && texel + step == min(texel + step, most)) return after.xyz - ray;
    vec4 before = texelFetch(rays, max(texel - step, ivec3(0)), 0);
    return before.w != 0.0 ? ray - before.xyz : vec3(0.0);
}

#ifdef TEXTURED
vec2 uvAt(vec3 heights) {
    return (heights.x * uvs[vertices.x] + heights.y * uvs[vertices.y] + heights.z * uvs[vertices.z]) /
           (heights.x + heights.y + heights.z);
}

// How far the texture moves to where a neighbouring ray meets the plane, which may be beyond its horizon.
vec2 changeOfUv(vec2 uv, vec3 neighbour) {
    const float endless = 1e4;
    vec3 heights = heightsAbove(edgePlanes, neighbour);
    return heights.x + heights.y + heights.z > 0.0 ? clamp(uvAt(heights) - uv, -endless, endless) : vec2(endless);
}
#endif

#ifdef EDGES
float coverageByEdges(vec3 heights, vec3 across, vec3 down) {
    float most = 0.0;
    for (int i = 0; i < 3; ++i) {
        vec2 gradient = vec2(dot(edgePlanes[i], across), dot(edgePlanes[i], down));
        most = max(most, strokeCoverage(distanceToLinePx(heights[i], gradient), edgeWidthsPx[i], sampling.z));
    }
    return most;
}
#endif

#ifdef LIT
#include "packed_normal.glsl"
#endif

void main() {
#ifdef COUNTS_COVERED
    gl_FragDepth = 0.0;
    result = vec4(0.0);
#else
#ifdef PER_SAMPLE
    ivec3 texel = ivec3(gl_FragCoord.xy, gl_SampleID);
#else
    ivec3 texel = ivec3(gl_FragCoord.xy, 0);
#endif
    vec4 ray = texelFetch(rays, texel, 0);
    vec3 heights = heightsAbove(edgePlanes, ray.xyz);
    bool isHit = ray.w != 0.0 && isInPart(ray.xyz);
    for (int i = 0; i < 3; ++i) isHit = isHit && isAbove(heights[i], edgePlanes[i]);
    // Where the plane is seen edge-on its distance may be anything, but no point of the triangle is beyond its corners.
    float inverse = max(dot(ray.xyz, inverseDistance.xyz), inverseDistance.w);
    if (!isHit || nearFraction * inverse > 1.0) discard;
    gl_FragDepth = nearFraction * inverse;
#ifdef COUNTS_HITS
    result = vec4(0.0);
#else
    Surface surface = Surface(vec3(0.0), vec4(1.0), vec3(0.0), (vertices.w & SEEN_FROM_BEHIND) != 0u, 0.0);
#if defined(OUTPUT_DEPTH) || defined(OUTPUT_POSITION)
    surface.ray = wallFromLens * (ray.xyz / inverse);
#endif
#if defined(TEXTURED) || defined(EDGES)
    vec3 across = changeOfRay(texel, ray.xyz, ivec2(1, 0)), down = changeOfRay(texel, ray.xyz, ivec2(0, 1));
#endif
#ifdef TEXTURED
    vec2 uv = uvAt(heights);
    surface.texel = textureGrad(baseColorTexture, uv, changeOfUv(uv, ray.xyz + across), changeOfUv(uv, ray.xyz + down));
#endif
#ifdef EDGES
    surface.line = coverageByEdges(heights, across, down);
#endif
#ifdef LIT
    surface.normal = heights.x * unpackNormal(normals[vertices.x]) + heights.y * unpackNormal(normals[vertices.y]) +
                     heights.z * unpackNormal(normals[vertices.z]);
#endif
    show(surface);
#endif
#endif
}
