// Planes through the x axis at equal angles, each sampled at equal angles: x is the angle A within the plane
// (0 to the left, pi to the right), y is the plane's angle psi about the x axis (up positive, 0 along -z).

SHARED_FN real3 sphereSlicesDirection(real2 angles) {
    return real3(-cos(angles.x), sin(angles.x) * sin(angles.y), -sin(angles.x) * cos(angles.y));
}

// Of a direction of any length. On the x axis, which lies in every plane, psi is 0.
SHARED_FN real2 sphereSlicesAngles(real3 direction) {
    real offAxis = length(real2(direction.y, direction.z));
    real psi = offAxis > 0.0 ? atan(direction.y, -direction.z) : 0.0;
    return real2(atan(offAxis, -direction.x), psi);
}
