// Exclusive sum over the invocations of a group.

shared uint prefixSums[GROUP_SIZE];

uint groupPrefix(uint value) {
    uint self = gl_LocalInvocationIndex;
    prefixSums[self] = value;
    barrier();
    for (uint reach = 1u; reach < GROUP_SIZE; reach *= 2u) {
        uint before = self >= reach ? prefixSums[self - reach] : 0u;
        barrier();
        prefixSums[self] += before;
        barrier();
    }
    return prefixSums[self] - value;
}
