// What the stages of the tessellation engine agree on.

const uint KEPT_VECTORS = 4u;
const uint KEPT = 4u * KEPT_VECTORS;  // pieces of a triangle that need no second walk

// Isolines drawn as points give any number up to lines * (segments + 1), none of them twice.
const uint MOST_POINTS_A_LINE = 65u;
const uint MOST_POINTS = 64u * MOST_POINTS_A_LINE;
