// What the stages of the tessellation engine agree on.

const uint KEPT_VECTORS = 4u;
const uint KEPT = 4u * KEPT_VECTORS;  // pieces of a triangle that need no second walk

const uint MOST_LINES = 64u, MOST_POINTS_A_LINE = 65u;
const uint MOST_POINTS = MOST_LINES * MOST_POINTS_A_LINE;
