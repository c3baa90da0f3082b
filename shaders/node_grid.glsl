// Which cells of a grid over the plane of sphere_bounds.glsl a box lies over. The grid is a pyramid, each level of half as
// many cells a side as the one before, down to a single cell; the box gets the first level of which it needs no more than
// kGridReach cells a side. Legal GLSL and legal C++ under GLM; C++ includes it through renderer/node_grid.h.

const int kGridReach = 8;

// From `first` to `last`, a row of the level being `width` cells and its first cell the `offset`th of all. None where
// last is before first.
struct GridCells {
    int offset;
    int width;
    ivec2 first;
    ivec2 last;
};

// The finest level begins at `least` and has `width` cells a side, a power of two.
SHARED_FN GridCells gridCellsUnder(BoxBounds box, real2 least, real2 cellsPerUnit, int width) {
    GridCells cells;
    cells.offset = 0;
    cells.width = width;
    cells.first = ivec2(0);
    cells.last = ivec2(-1);
    real end = real(width);
    real2 from = (box.least - least) * cellsPerUnit;
    real2 to = (box.most - least) * cellsPerUnit;
    bool isBeside = to.x < 0.0 || to.y < 0.0 || from.x >= end || from.y >= end;
    if (box.kind == kSphereNothing || isBeside) return cells;

    // Open sides end at the grid's.
    cells.first = ivec2(int(max(from.x, 0.0)), int(max(from.y, 0.0)));
    cells.last = ivec2(int(min(to.x, end - 0.5)), int(min(to.y, end - 0.5)));
    while (cells.last.x - cells.first.x >= kGridReach || cells.last.y - cells.first.y >= kGridReach) {
        cells.offset += cells.width * cells.width;
        cells.width /= 2;
        cells.first /= 2;
        cells.last /= 2;
    }
    return cells;
}
