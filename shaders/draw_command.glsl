// As glDrawArraysIndirect reads it, and behind that where the pairs end: the last instance may be longer than they are.

struct DrawCommand {
    uint count;
    uint instanceCount;
    uint first;
    uint baseInstance;
    uint endPair;
};
