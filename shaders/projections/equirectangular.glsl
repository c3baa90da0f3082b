// Longitude (right positive) and latitude (up positive), both 0 along -z.

SHARED_FN real3 equirectangularDirection(real2 angles) {
    return real3(cos(angles.y) * sin(angles.x), sin(angles.y), -cos(angles.y) * cos(angles.x));
}

// Of a direction of any length. At a pole, where every longitude is right, it is 0.
SHARED_FN real2 equirectangularAngles(real3 direction) {
    real level = length(real2(direction.x, direction.z));
    real longitude = level > 0.0 ? atan(direction.x, -direction.z) : 0.0;
    return real2(longitude, atan(direction.y, level));
}
