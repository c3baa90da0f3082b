// Bounds what a round lens shows of a triangle by a few triangles in the picture, and sends along what rays need to meet it
// (Gascuel et al., Fast Non-Linear Projections using Graphics Hardware, 2008).

#define real float
#define real2 vec2
#define real3 vec3
#include "radial.glsl"
#include "bounding_shapes.glsl"
#include "bounded_flags.glsl"

layout(triangles) in;
layout(triangle_strip, max_vertices = MOST_CORNERS) out;

layout(location = 0) in vec3 corner[];
layout(location = 1) flat in uint cornerVertex[];
#ifdef EDGES
layout(location = 2) flat in vec3 cornerEdgeWidthsPx[];
#endif

layout(location = 9) uniform float nearFraction;
layout(location = 14) uniform vec2 shift;  // of the whole picture, clip space, for one sample of several
layout(location = 30) uniform float coefficients[kRadialTerms];
layout(location = 39) uniform vec2 centreInClipSpace;
layout(location = 40) uniform vec2 focalInClipSpace;  // y up on the lens is towards row 0
layout(location = 41) uniform float edgeRad;
layout(location = 42) uniform float margin;  // focal lengths

layout(location = 0) flat out vec3 edgePlanes[3];  // edge i lies opposite corner i; what is inside is above all of them
layout(location = 3) flat out vec4 inverseDistance;  // along a ray of length one: dot(ray, xyz), at least w
layout(location = 4) flat out uvec4 vertices;  // and flags
#ifdef PARTED
layout(location = 5) flat out vec3 cut;
#endif
#ifdef EDGES
layout(location = 6) flat out vec3 edgeWidthsPx;
#endif

// What each corner of a shape carries.
struct Carried {
    vec3 edgePlanes[3];
    vec4 inverseDistance;
    uvec4 vertices;
    vec3 cut;
    float depth;  // nothing of the triangle is nearer
};

float squareOf(vec3 v) {
    precise float square = v.x * v.x + v.y * v.y + v.z * v.z;
    return square;
}

// Neighbours must have the same plane but for its sign, to the last bit, so that each ray is above one of them: built from
// the ends in an order that both know, and relative to the nearer one, so that short edges are as exact as long ones.
vec3 edgePlane(vec3 p, vec3 q) {
    float ofP = squareOf(p), ofQ = squareOf(q);
    bool swapped = ofP != ofQ ? ofP > ofQ : p.x != q.x ? p.x > q.x : p.y != q.y ? p.y > q.y : p.z > q.z;
    vec3 from = swapped ? q : p, way = swapped ? p - q : q - p;
    precise vec3 plane = from.yzx * way.zxy - from.zxy * way.yzx;
    return swapped ? -plane : plane;
}

// xyz is normal to the triangle's plane, and w that times any of its points: of the nearest corner, since the roundings are
// a share of its distance.
vec4 planeOf(vec3 a, vec3 b, vec3 c) {
    float ofA = squareOf(a), ofB = squareOf(b), ofC = squareOf(c);
    bool isB = ofB < ofA && ofB <= ofC, isC = ofC < ofA && !isB;
    vec3 near = isB ? b : isC ? c : a;
    vec3 normal = cross((isB ? c : isC ? a : b) - near, (isB ? a : isC ? b : c) - near);
    return vec4(normal, dot(near, normal));
}

// At most 1 / distance of any point of the triangle, whose plane is 1 / `toPlane` away.
float mostInverseDistance(vec3 a, vec3 b, vec3 c, float toPlane) {
    vec3 middle = (a + b + c) / 3.0;
    float radius = max(distance(a, middle), max(distance(b, middle), distance(c, middle)));
    float least = length(middle) - radius;
    return 1.0001 * (least > 0.0 ? min(toPlane, 1.0 / least) : toPlane);
}

void emitCorner(vec2 place, Carried carried) {
    edgePlanes = carried.edgePlanes;
    inverseDistance = carried.inverseDistance;
    vertices = carried.vertices;
#ifdef PARTED
    cut = carried.cut;
#endif
#ifdef EDGES
    edgeWidthsPx = cornerEdgeWidthsPx[0];
#endif
    gl_Position = vec4(centreInClipSpace + place * focalInClipSpace + shift, carried.depth, 1.0);
    EmitVertex();
}

#ifdef PARTED
void sendTriangles(BoundingTriangles triangles, Carried carried) {
    carried.cut = triangles.cut;
    for (int i = 0; i < 3 * triangles.count; ++i) {
        if (i == 3 * triangles.before) carried.vertices.w |= BELOW_CUT;
        emitCorner(triangles.corners[i], carried);
        if (i % 3 == 2) EndPrimitive();
    }
}
#endif

#ifdef BOUNDS_QUAD
void sendQuad(BoundingQuad quad, Carried carried) {
    if (quad.count == 0) return;
    emitCorner(quad.corners[0], carried);
    emitCorner(quad.corners[1], carried);
    emitCorner(quad.corners[3], carried);
    emitCorner(quad.corners[2], carried);
    EndPrimitive();
}
#endif

void sendShapes(vec3 a, vec3 b, vec3 c, Carried carried) {
    const float quarterTurn = 1.57079633;
    float front = min(edgeRad, quarterTurn);
#ifdef BOUNDS_QUAD
    sendQuad(BOUNDS_QUAD(LENS, coefficients, front, margin, a, b, c), carried);
#else
    sendTriangles(triangleBounds(LENS, coefficients, front, margin, a, b, c), carried);
#endif
#ifdef WIDE
    carried.vertices.w |= BEHIND_THE_LENS;
    sendTriangles(ringBounds(LENS, coefficients, edgeRad, margin, a, b, c), carried);
#endif
}

void main() {
    vec3 a = corner[0], b = corner[1], c = corner[2];
    vec4 plane = planeOf(a, b, c);
    float determinant = plane.w;
    if (determinant == 0.0 || isnan(determinant) || isinf(determinant)) return;
    bool behind = determinant > 0.0;
#ifdef SINGLE_SIDED
    if (behind) return;
#endif
    Carried carried;
    carried.edgePlanes = vec3[](edgePlane(b, c), edgePlane(c, a), edgePlane(a, b));
    for (int i = 0; i < 3; ++i) carried.edgePlanes[i] = behind ? carried.edgePlanes[i] : -carried.edgePlanes[i];
    vec3 inverse = plane.xyz / determinant;
    float farthest = sqrt(max(dot(a, a), max(dot(b, b), dot(c, c))));
    carried.inverseDistance = vec4(inverse, 1.0 / farthest);
    carried.vertices = uvec4(cornerVertex[0], cornerVertex[1], cornerVertex[2], behind ? SEEN_FROM_BEHIND : 0u);
    carried.cut = vec3(0.0);
    carried.depth = min(nearFraction * mostInverseDistance(a, b, c, length(inverse)), 1.0);
    sendShapes(a, b, c, carried);
}
