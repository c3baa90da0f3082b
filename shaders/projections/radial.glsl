// Round lenses: what lies `angle` off the axis lands `radius` from the centre of the picture, in focal
// lengths. The axis is -z.

const int kOrthographic = 0;
const int kStereographic = 1;
const int kEquisolid = 2;
const int kEquidistant = 3;
const int kPolynomial = 4;

// A polynomial without constant term: c[0] t + c[1] t^2 + ...
const int kRadialTerms = 9;

SHARED_FN real polynomialRadius(const real c[kRadialTerms], real angle) {
    real sum = 0.0;
    for (int i = kRadialTerms - 1; i >= 0; --i) sum = (sum + c[i]) * angle;
    return sum;
}

SHARED_FN real polynomialSlope(const real c[kRadialTerms], real angle) {
    real sum = 0.0;
    for (int i = kRadialTerms - 1; i >= 0; --i) sum = sum * angle + real(i + 1) * c[i];
    return sum;
}

// The angle from 0 to `most` with this radius, for a polynomial that increases there: Newton's steps, kept
// between bounds that close in.
SHARED_FN real polynomialAngle(const real c[kRadialTerms], real radius, real most) {
    real low = 0.0;
    real high = most;
    real angle = most * min(radius / polynomialRadius(c, most), 1.0);
    for (int i = 0; i < 100; ++i) {
        real excess = polynomialRadius(c, angle) - radius;
        real newton = angle - excess / polynomialSlope(c, angle);
        if (excess == 0.0 || newton == angle) break;
        if (excess > 0.0) {
            high = angle;
        } else {
            low = angle;
        }
        angle = newton > low && newton < high ? newton : 0.5 * (low + high);
        if (!(angle > low && angle < high)) break;
    }
    return angle;
}

SHARED_FN real radialRadius(int model, const real c[kRadialTerms], real angle) {
    if (model == kOrthographic) return sin(angle);
    if (model == kStereographic) return 2.0 * tan(0.5 * angle);
    if (model == kEquisolid) return 2.0 * sin(0.5 * angle);
    if (model == kEquidistant) return angle;
    return polynomialRadius(c, angle);
}

// GLSL promises little of asin, and drivers are off by 1e-3 near 1; nothing beyond 1.
SHARED_FN real arcSine(real s) { return atan(s, sqrt(max((1.0 - s) * (1.0 + s), 0.0))); }

// The inverse up to the angle `most`.
SHARED_FN real radialAngle(int model, const real c[kRadialTerms], real radius, real most) {
    if (model == kOrthographic) return arcSine(radius);
    if (model == kStereographic) return 2.0 * atan(0.5 * radius);
    if (model == kEquisolid) return 2.0 * arcSine(0.5 * radius);
    if (model == kEquidistant) return radius;
    return polynomialAngle(c, radius, most);
}

// Straight behind the lens, where every side is right, it is the right.
SHARED_FN real2 radialPosition(int model, const real c[kRadialTerms], real3 direction) {
    real offAxis = length(real2(direction.x, direction.y));
    real radius = radialRadius(model, c, atan(offAxis, -direction.z));
    return offAxis > 0.0 ? real2(direction.x, direction.y) * (radius / offAxis) : real2(radius, 0.0);
}

// Sine and cosine of the angle with this radius, without the angle where formulas need none.
SHARED_FN real2 radialSineCosine(int model, const real c[kRadialTerms], real radius, real most) {
    if (model == kOrthographic) return real2(radius, sqrt(max((1.0 - radius) * (1.0 + radius), 0.0)));
    if (model == kStereographic) {
        real squared = 0.25 * radius * radius;
        return real2(radius, 1.0 - squared) / (1.0 + squared);
    }
    if (model == kEquisolid) {
        real sineOfHalf = 0.5 * radius;
        return real2(radius * sqrt(max((1.0 - sineOfHalf) * (1.0 + sineOfHalf), 0.0)), 1.0 - 2.0 * sineOfHalf * sineOfHalf);
    }
    real angle = radialAngle(model, c, radius, most);
    return real2(sin(angle), cos(angle));
}

SHARED_FN real3 radialDirection(int model, const real c[kRadialTerms], real2 position, real most) {
    real radius = length(position);
    real2 sineCosine = radialSineCosine(model, c, radius, most);
    real2 side = radius > 0.0 ? position / radius : real2(1.0, 0.0);
    return real3(sineCosine.x * side.x, sineCosine.x * side.y, -sineCosine.y);
}
