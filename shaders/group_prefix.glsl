// Exclusive sum over the invocations of a group. One barrier: a tree of sums would need one a step, each of which costs a
// software renderer more than all these additions.

shared uint groupValues[GROUP_SIZE];

uint groupPrefix(uint value) {
    uint self = gl_LocalInvocationIndex;
    groupValues[self] = value;
    barrier();
    uint sum = 0u;
    for (uint i = 0u; i < GROUP_SIZE; ++i) sum += i < self ? groupValues[i] : 0u;
    return sum;
}
