// The distortion of OpenCV's pinhole camera, on the plane one unit ahead: x right, y down, before focal
// length and principal point. k holds k1 k2 p1 p2 k3 k4 k5 k6 s1 s2 s3 s4, all that comes before the tilt.
// Source: the OpenCV documentation, "Camera Calibration and 3D Reconstruction".

const int kPinholeTerms = 12;

SHARED_FN real2 pinholeDistorted(const real k[kPinholeTerms], real2 p) {
    real r2 = dot(p, p);
    real above = 1.0 + r2 * (k[0] + r2 * (k[1] + r2 * k[4]));
    real perBelow = 1.0 / (1.0 + r2 * (k[5] + r2 * (k[6] + r2 * k[7])));
    real radial = above * perBelow;
    real cross2 = 2.0 * p.x * p.y;
    return real2(p.x * radial + k[2] * cross2 + k[3] * (r2 + 2.0 * p.x * p.x) + r2 * (k[8] + r2 * k[9]),
                 p.y * radial + k[2] * (r2 + 2.0 * p.y * p.y) + k[3] * cross2 + r2 * (k[10] + r2 * k[11]));
}

// Its derivatives, row by row.
SHARED_FN real4 pinholeJacobian(const real k[kPinholeTerms], real2 p) {
    real r2 = dot(p, p);
    real above = 1.0 + r2 * (k[0] + r2 * (k[1] + r2 * k[4]));
    real perBelow = 1.0 / (1.0 + r2 * (k[5] + r2 * (k[6] + r2 * k[7])));
    real radial = above * perBelow;
    real slope =
        (k[0] + r2 * (2.0 * k[1] + r2 * 3.0 * k[4]) - radial * (k[5] + r2 * (2.0 * k[6] + r2 * 3.0 * k[7]))) *
        perBelow;
    real2 prism = real2(2.0 * k[8] + 4.0 * r2 * k[9], 2.0 * k[10] + 4.0 * r2 * k[11]);
    real both = 2.0 * (p.x * p.y * slope + k[2] * p.x + k[3] * p.y);
    return real4(radial + 2.0 * p.x * p.x * slope + 2.0 * k[2] * p.y + 6.0 * k[3] * p.x + p.x * prism.x,
                 both + p.y * prism.x, both + p.x * prism.y,
                 radial + 2.0 * p.y * p.y * slope + 6.0 * k[2] * p.y + 2.0 * k[3] * p.x + p.y * prism.y);
}

// As pinholeUndistorted, beginning at a point nearer to the axis than `mostRadius`.
SHARED_FN real3 pinholeUndistortedFrom(const real k[kPinholeTerms], real2 distorted, real2 start,
                                       real mostRadius, real tolerance) {
    real2 p = start;
    real2 error = pinholeDistorted(k, p) - distorted;
    real left = dot(error, error);
    real most = tolerance * tolerance * max(dot(distorted, distorted), 1.0);
    for (int i = 0; i < 100 && left > most; ++i) {
        real4 j = pinholeJacobian(k, p);
        real2 step = real2(j.w * error.x - j.y * error.y, j.x * error.y - j.z * error.x) *
                     (1.0 / (j.x * j.w - j.y * j.z));
        real2 next = p - step;
        error = pinholeDistorted(k, next) - distorted;
        for (int h = 0;
             h < 50 && !(dot(next, next) < mostRadius * mostRadius && dot(error, error) < left); ++h) {
            step = 0.5 * step;
            next = p - step;
            error = pinholeDistorted(k, next) - distorted;
        }
        if (!(dot(error, error) < left)) break;
        p = next;
        left = dot(error, error);
    }
    return real3(p, left <= most ? 1.0 : 0.0);
}

// The point nearer to the axis than `mostRadius` that distorts to `distorted`, to within `tolerance` of one
// or of what is larger: x, y and 1, or a z of 0 where there is none. Newton's steps, halved until they stay
// within the radius and come nearer: where the distortion is one-to-one nothing but the answer stops them.
SHARED_FN real3 pinholeUndistorted(const real k[kPinholeTerms], real2 distorted, real mostRadius,
                                   real tolerance) {
    real2 p = distorted * min(0.5 * mostRadius / max(length(distorted), 1e-30), 1.0);
    return pinholeUndistortedFrom(k, distorted, p, mostRadius, tolerance);
}

// Through a homography of the plane, as OpenCV tilts the sensor; z is positive where the answer counts.
SHARED_FN real3 pinholeTilted(real3x3 tilt, real2 p) {
    real3 h = tilt * real3(p, 1.0);
    return real3(h.x / h.z, h.y / h.z, h.z);
}
