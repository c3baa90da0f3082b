// Normals are packed as signed 10-bit integers, x lowest.
vec3 unpackNormal(uint bits) {
    ivec3 parts = ivec3(int(bits << 22u) >> 22, int(bits << 12u) >> 22, int(bits << 2u) >> 22);
    return vec3(parts) / 511.0;
}
