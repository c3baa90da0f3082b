// Exclusive sum over the invocations of a group. One of them adds: that costs a software renderer less than a sum of each
// invocation's own, which reads all values that often, or a tree of sums with a barrier a step.

shared uint groupSums[GROUP_SIZE];

uint groupPrefix(uint value) {
    uint self = gl_LocalInvocationIndex;
    groupSums[self] = value;
    barrier();
    if (self == 0u) {
        uint sum = 0u;
        for (uint i = 0u; i < GROUP_SIZE; ++i) {
            uint own = groupSums[i];
            groupSums[i] = sum;
            sum += own;
        }
    }
    barrier();
    return groupSums[self];
}
