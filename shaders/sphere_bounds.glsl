// Where a sphere lies on a flat screen, after Mara and McGuire, "2D Polyhedral Bounds of a Clipped,
// Perspective-Projected 3D Sphere" (JCGT 2013). The eye is the origin, the screen has the unit normal
// `ahead`, and only what is further ahead than `near` (0 or more) is seen. A place on the screen is (right .
// p, down . p) / (ahead . p). Legal GLSL and legal C++ under GLM; C++ includes it through
// renderer/sphere_bounds.h.

// What is seen of a sphere: nothing, or kSphereSeen and in which directions it goes on for ever.
const int kSphereNothing = 0;
const int kSphereSeen = 1;
const int kSphereOpenBelow = 2;  // along an axis; in a box: along either
const int kSphereOpenAbove = 4;

// What an open side has for a bound.
const real kSphereOpen = 1e30;

struct AxisBounds {
    int kind;
    real least;
    real most;
};

struct BoxBounds {
    int kind;
    real2 least;
    real2 most;
};

// The upper bound of a / z over a disc about (a, z) cut at z > near, as (a, z) of the point that has it; z is
// 0 where there is none. `tangent` is the distance to the tangent points, 0 from inside (sections 3.1
// and 3.2, figures 4 and 5). The far end of the tangent is seen, or the near line cuts it off and the end of
// the chord takes its place.
SHARED_FN real2 sphereUpperPoint(real a, real z, real radius, real near, real tangent) {
    real2 touch = real2(a * tangent + z * radius, z * tangent - a * radius) * (tangent / (a * a + z * z));
    if (tangent > 0.0 && touch.y > near) return touch;
    real below = near - z;
    return real2(a + sqrt(max((radius - below) * (radius + below), 0.0)), near);
}

// The tightest bounds of (axis . p) / (ahead . p) over the sphere's seen part. `axis` has length one and lies
// in the screen. Over the sphere they are those of the disc that it is in the plane of both (section 2,
// figure 3).
SHARED_FN AxisBounds sphereAxisBounds(real3 centre, real radius, real3 axis, real3 ahead, real near) {
    AxisBounds bounds;
    bounds.kind = kSphereNothing;
    bounds.least = kSphereOpen;
    bounds.most = -kSphereOpen;
    real a = dot(axis, centre);
    real z = dot(ahead, centre);
    if (z + radius <= near) return bounds;

    // With the eye inside the disc no line through it touches, and the near line bounds both sides.
    real distance = sqrt(a * a + z * z);
    real tangent = sqrt(max((distance - radius) * (distance + radius), 0.0));
    real2 low = sphereUpperPoint(-a, z, radius, near, tangent);
    real2 high = sphereUpperPoint(a, z, radius, near, tangent);
    bounds.kind = kSphereSeen | (low.y > 0.0 ? 0 : kSphereOpenBelow) | (high.y > 0.0 ? 0 : kSphereOpenAbove);
    bounds.least = low.y > 0.0 ? -low.x / low.y : -kSphereOpen;
    bounds.most = high.y > 0.0 ? high.x / high.y : kSphereOpen;
    return bounds;
}

// The box of the seen part with sides along `right` and `down` (section 4, listing 2).
SHARED_FN BoxBounds sphereBoxBounds(real3 centre, real radius, real3 right, real3 down, real3 ahead,
                                    real near) {
    AxisBounds across = sphereAxisBounds(centre, radius, right, ahead, near);
    AxisBounds along = sphereAxisBounds(centre, radius, down, ahead, near);
    BoxBounds bounds;
    bounds.kind = across.kind | along.kind;
    bounds.least = real2(across.least, along.least);
    bounds.most = real2(across.most, along.most);
    return bounds;
}

// One side of the n-gon about the seen part (section 4): all of it has dot(side, place) <= the result, which
// is kSphereOpen where no line of that direction bounds it and -kSphereOpen where nothing is seen. `side` has
// length one.
SHARED_FN real sphereSideBound(real3 centre, real radius, real2 side, real3 right, real3 down, real3 ahead,
                               real near) {
    return sphereAxisBounds(centre, radius, side.x * right + side.y * down, ahead, near).most;
}

// A radius with which bounds computed in single precision hold for the exact sphere. Beside it the roundings
// of a bound are small; they count where the eye is close to the surface, as the root of a difference that
// vanishes.
SHARED_FN real sphereRoundedOut(real3 centre, real radius) {
    return radius + 2e-6 * (length(centre) + radius);
}
