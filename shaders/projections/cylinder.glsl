// A cylinder about the y axis; the middle column looks along -z. Needs root_ahead.glsl.

// The point of column angle `angle` (right positive) and height `y` on a wall of this radius.
SHARED_FN real3 cylinderPoint(real radius, real angle, real y) {
    return real3(radius * sin(angle), y, -radius * cos(angle));
}

// How far along `ray` the wall lies for an eye at `eye` inside it; infinite along the axis.
SHARED_FN real cylinderDistance(real radius, real3 eye, real3 ray) {
    return rootAhead(ray.x * ray.x + ray.z * ray.z, eye.x * ray.x + eye.z * ray.z,
                     eye.x * eye.x + eye.z * eye.z - radius * radius);
}

// Column angle and height of a point on the wall.
SHARED_FN real2 cylinderPosition(real3 point) { return real2(atan(point.x, -point.z), point.y); }
