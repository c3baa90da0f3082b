// Flat shapes around the picture of a triangle through a round lens, after Gascuel, Holzschuch, Fournier and Péroche,
// "Fast Non-Linear Projections using Graphics Hardware" (I3D 2008). Corners a, b, c are seen from the eye in lens axes
// (forward -z, x right, y up); a place in the picture is as in shaders/projections/radial.glsl, which comes before this
// file. Legal GLSL and legal C++ under GLM; C++ includes it through renderer/bounding_shapes.h.

// Triangles with corners 3 i, 3 i + 1, 3 i + 2. Those before number `before` are for the directions with
// dot(cut, direction) >= 0, the others for < 0, so that no fragment counts twice; a shape in one piece has the cut 0.
struct BoundingTriangles {
    int count;
    int before;
    real3 cut;
    real2 corners[12];
};

// Four corners in order around it, if `count` is 1.
struct BoundingQuad {
    int count;
    real2 corners[4];
};

// Around what is seen of the triangle ahead (angle at most `edge` and a quarter turn), pushed out by `margin`.
SHARED_FN BoundingQuad quadBounds(int model, const real coefficients[kRadialTerms], real edge, real margin, real3 a,
                                  real3 b, real3 c) {
    real reach = radialRadius(model, coefficients, min(edge, 0.5 * 3.14159265358979)) + margin;
    BoundingQuad quad;
    quad.count = a == b || b == c || c == a ? 0 : 1;
    quad.corners[0] = real2(-reach, -reach);
    quad.corners[1] = real2(reach, -reach);
    quad.corners[2] = real2(reach, reach);
    quad.corners[3] = real2(-reach, reach);
    return quad;
}

// The same, tighter.
SHARED_FN BoundingTriangles triangleBounds(int model, const real coefficients[kRadialTerms], real edge, real margin,
                                           real3 a, real3 b, real3 c) {
    BoundingQuad quad = quadBounds(model, coefficients, edge, margin, a, b, c);
    BoundingTriangles triangles;
    triangles.count = 2 * quad.count;
    triangles.before = triangles.count;
    triangles.cut = real3(0.0, 0.0, 0.0);
    triangles.corners[0] = quad.corners[0];
    triangles.corners[1] = quad.corners[1];
    triangles.corners[2] = quad.corners[2];
    triangles.corners[3] = quad.corners[0];
    triangles.corners[4] = quad.corners[2];
    triangles.corners[5] = quad.corners[3];
    return triangles;
}

// Around what is seen of it behind (angle from a quarter turn to `edge`).
SHARED_FN BoundingTriangles ringBounds(int model, const real coefficients[kRadialTerms], real edge, real margin,
                                       real3 a, real3 b, real3 c) {
    real reach = radialRadius(model, coefficients, edge) + margin;
    BoundingTriangles triangles;
    triangles.count = a == b || b == c || c == a || edge <= 0.5 * 3.14159265358979 ? 0 : 2;
    triangles.before = triangles.count;
    triangles.cut = real3(0.0, 0.0, 0.0);
    triangles.corners[0] = real2(-reach, -reach);
    triangles.corners[1] = real2(reach, -reach);
    triangles.corners[2] = real2(reach, reach);
    triangles.corners[3] = real2(-reach, -reach);
    triangles.corners[4] = real2(reach, reach);
    triangles.corners[5] = real2(-reach, reach);
    return triangles;
}
