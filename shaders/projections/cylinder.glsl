// A cylinder about the y axis; the middle column looks along -z.

// The point of column angle `angle` (right positive) and height `y` on a wall of this radius.
SHARED_FN real3 cylinderPoint(real radius, real angle, real y) {
    return real3(radius * sin(angle), y, -radius * cos(angle));
}

// How far along `ray` the wall lies for an eye at `eye` inside it; infinite along the axis. The one root
// ahead of a t^2 + 2 b t + c = 0 with c < 0, written without cancellation.
SHARED_FN real cylinderDistance(real radius, real3 eye, real3 ray) {
    real a = ray.x * ray.x + ray.z * ray.z;
    real b = eye.x * ray.x + eye.z * ray.z;
    real c = eye.x * eye.x + eye.z * eye.z - radius * radius;
    real root = sqrt(b * b - a * c);
    return b > 0.0 ? -c / (b + root) : (root - b) / a;
}

// Column angle and height of a point on the wall.
SHARED_FN real2 cylinderPosition(real3 point) { return real2(atan(point.x, -point.z), point.y); }
