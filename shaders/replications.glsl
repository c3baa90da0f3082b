// Shared by the passes of the geometry engine.

const uint KEPT = 3u;  // pieces of a triangle that need no second walk; most triangles touch fewer
