// Turns the counts of groups into the place of each group's first. One group runs. MESHLETS: of meshlets that show something,
// for as many groups of coverage.comp; PAIRS: of the pairs of those groups.

layout(local_size_x = GROUP_SIZE) in;

layout(std430, binding = 4) buffer Counts { uint counts[]; };  // one more at the end becomes the sum of all
layout(std430, binding = 12) buffer Dispatch { uint dispatch[3]; };
layout(std430, binding = 13) buffer Totals { uint totals[]; };  // of each part, as renderer/coverage.h has them

#ifdef MESHLETS
layout(location = 6) uniform uint groupCount;
#endif
layout(location = 7) uniform uint part;

shared uint sums[GROUP_SIZE];

// Sums stay at the largest number rather than start again at zero: too many pairs must look like too many.
uint saturatingSum(uint a, uint b) { return a + b < a ? 0xffffffffu : a + b; }

void main() {
#ifndef MESHLETS
    uint groupCount = dispatch[0];
#endif
    uint self = gl_LocalInvocationIndex;
    uint share = (groupCount + GROUP_SIZE - 1u) / GROUP_SIZE;
    uint begin = min(self * share, groupCount), end = min(begin + share, groupCount);
    uint sum = 0u;
    for (uint i = begin; i < end; ++i) sum = saturatingSum(sum, counts[i]);
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
        uint count = counts[i];
        counts[i] = next;
        next = saturatingSum(next, count);
    }
    if (self == GROUP_SIZE - 1u) {
        counts[groupCount] = sums[self];
#ifdef MESHLETS
        dispatch[0] = sums[self];
        dispatch[1] = 1u;
        dispatch[2] = 1u;
        uint total = 3u * part + 1u;
#else
        uint total = 3u * part;
#endif
        totals[total] = max(totals[total], sums[self]);  // of the passes of a frame
    }
}
