// Turns the pair counts of the coverage groups into the index of each group's first pair. One group runs.

layout(local_size_x = GROUP_SIZE) in;

layout(std430, binding = 4) buffer GroupPairs { uint groupPairs[]; };
layout(std430, binding = 5) buffer FirstPair { uint firstPair[]; };
layout(std430, binding = 3) writeonly buffer Totals { uint totals[]; };  // read by the CPU after the frame

layout(location = 3) uniform uint triangleCount;
layout(location = 6) uniform uint groupCount;
layout(location = 7) uniform uint part;

shared uint sums[GROUP_SIZE];

// Sums stay at the largest number rather than start again at zero: too many pairs must look like too many.
uint saturatingSum(uint a, uint b) { return a + b < a ? 0xffffffffu : a + b; }

void main() {
    uint self = gl_LocalInvocationIndex;
    uint share = (groupCount + GROUP_SIZE - 1u) / GROUP_SIZE;
    uint begin = min(self * share, groupCount), end = min(begin + share, groupCount);
    uint sum = 0u;
    for (uint i = begin; i < end; ++i) sum = saturatingSum(sum, groupPairs[i]);
    sums[self] = sum;
    barrier();
    for (uint reach = 1u; reach < GROUP_SIZE; reach *= 2u) {
        uint before = self >= reach ? sums[self - reach] : 0u;
        barrier();
        sums[self] = saturatingSum(sums[self], before);
        barrier();
    }
    uint next = sums[self] - sum;
    for (uint i = begin; i < end; ++i) {
        uint count = groupPairs[i];
        groupPairs[i] = next;
        next = saturatingSum(next, count);
    }
    if (self == GROUP_SIZE - 1u) {
        totals[part] = sums[self];
        firstPair[triangleCount] = sums[self];
    }
}
