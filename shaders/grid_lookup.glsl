// The nodes of the piece tree between which a sphere's lie, from a NodeGrid of renderer/node_grid.h.

#define real float
#define real2 vec2
#define real3 vec3
#include "sphere_bounds.glsl"
#include "node_grid.glsl"

const int MOST_PLANES = 6;

struct GridPlane {
    vec4 right, down, ahead;
    vec2 least, cellsPerUnit;
};
layout(std430, binding = 2) readonly buffer NodeGrid {
    GridPlane planes[MOST_PLANES];
    int planeCount, width;
    int cellsOfPlane, reserved;
    uvec2 ranges[];
} grid;

uvec2 nodesTouched(vec3 centre, float radius) {
    uvec2 touched = uvec2(0xffffffffu, 0u);
    float outer = sphereRoundedOut(centre, radius);
    for (int i = 0; i < MOST_PLANES; ++i) {
        if (i >= grid.planeCount) break;
        GridPlane plane = grid.planes[i];
        BoxBounds box = sphereBoxBounds(centre, outer, plane.right.xyz, plane.down.xyz, plane.ahead.xyz, 0.0);
        GridCells cells = gridCellsUnder(box, plane.least, plane.cellsPerUnit, grid.width);
        int first = i * grid.cellsOfPlane + cells.offset;
        for (int y = cells.first.y; y <= cells.last.y; ++y) {
            for (int x = cells.first.x; x <= cells.last.x; ++x) {
                uvec2 range = grid.ranges[first + y * cells.width + x];
                touched = uvec2(min(touched.x, range.x), max(touched.y, range.y));
            }
        }
    }
    return touched;
}
