#pragma once
// Meshes of convex polygons of three to six edges that share their vertices.

#include "calibration/pieces/piece_mesh.h"
#include "calibration/projections/projection.h"
#include "tests/support/random_numbers.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace curvewall::test {

struct Honeycomb {
    int columns = 0;       // of half a cell's width
    int rows = 0;          // of cells
    double wobble = 0;     // of vertices, as a share of what keeps the cells convex
    double collapsed = 0;  // this share of the vertices takes the place of a neighbour
};

// Cells like bricks whose long sides are broken, with random vertices that are on no grid: six corners
// inside, of which some lie in one line, four at the ends of rows. Half of the six-sided cells are cut in two
// by a diagonal. Vertices on the border stay there. The m and the homographies are left out.
inline PieceMesh honeycombMesh(glm::ivec2 sizePx, const Honeycomb& honeycomb, Random& random) {
    const int columns = honeycomb.columns, rows = honeycomb.rows;
    const glm::dvec2 cell = glm::dvec2(sizePx) / glm::dvec2(columns, rows);
    PieceMesh mesh{sizePx, {}, {}};
    const auto indexOf = [&](int x, int y) { return static_cast<uint32_t>(y * (columns + 1) + x); };
    for (int y = 0; y <= rows; ++y) {
        for (int x = 0; x <= columns; ++x) {
            glm::dvec2 s = glm::dvec2(x, y) * cell;
            if (x == columns) s.x = sizePx.x;
            if (y == rows) s.y = sizePx.y;
            const bool isInside = x > 0 && x < columns && y > 0 && y < rows;
            if (isInside) {
                const double up = (x + y) % 2 == 1 ? -0.15 : 0.15;
                s += cell * glm::dvec2(random.uniform(-0.2, 0.2) * honeycomb.wobble,
                                       up + random.uniform(-0.1, 0.1) * honeycomb.wobble);
                if (random.uniform(0, 1) < honeycomb.collapsed) s = mesh.vertices.back().s;
            }
            mesh.vertices.push_back({{}, s});
        }
    }
    const auto add = [&](const std::vector<uint32_t>& corners) {
        Piece piece;
        for (uint32_t corner : corners) piece.vertices[piece.vertexCount++] = corner;
        mesh.pieces.push_back(piece);
    };
    for (int y = 0; y < rows; ++y) {
        for (int x = y % 2 == 0 ? 0 : -1; x < columns; x += 2) {
            std::vector<uint32_t> around;
            for (int i = std::max(x, 0); i <= std::min(x + 2, columns); ++i) around.push_back(indexOf(i, y));
            for (int i = std::min(x + 2, columns); i >= std::max(x, 0); --i)
                around.push_back(indexOf(i, y + 1));
            const bool isInside = y > 0 && y + 1 < rows;
            if (isInside && around.size() == 6 && random.uniform(0, 1) < 0.5) {
                const auto turn = static_cast<std::ptrdiff_t>(random.uniform(0, 6));
                std::rotate(around.begin(), around.begin() + turn, around.end());
                const auto end = 2 + static_cast<std::ptrdiff_t>(random.uniform(0, 3));
                std::vector<uint32_t> rest(around.begin() + end, around.end());
                rest.push_back(around.front());
                around.resize(static_cast<size_t>(end) + 1);
                add(rest);
            }
            add(around);
        }
    }
    return mesh;
}

// The same with its vertices where a flat display has them, so that all its pieces are exact.
inline PieceMesh honeycombOn(const Projection& flat, glm::ivec2 sizePx, const Honeycomb& honeycomb,
                             Random& random) {
    PieceMesh mesh = honeycombMesh(sizePx, honeycomb, random);
    for (PieceVertex& vertex : mesh.vertices) vertex.m = *flat.unproject(vertex.s);
    updateHomographies(mesh);
    return mesh;
}

}  // namespace curvewall::test
