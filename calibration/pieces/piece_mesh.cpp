#include "calibration/pieces/piece_mesh.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>

namespace curvewall {
namespace {

constexpr double kRounding = 1e-12;  // of the largest coordinate

constexpr double kNoLengthPx = 1e-9;

double doubleArea(glm::dvec2 a, glm::dvec2 b, glm::dvec2 c) {
    const glm::dvec2 u = b - a, v = c - a;
    return u.x * v.y - u.y * v.x;
}

// One side of a piece on the screen.
struct ScreenSide {
    glm::dvec2 from;
    glm::dvec2 inward;  // of length one
};

std::vector<ScreenSide> screenSides(const PieceMesh& mesh, const Piece& piece) {
    const auto [a, b, c] = widestTriangle(mesh, piece);
    const double turn = doubleArea(a.s, b.s, c.s) > 0 ? 1 : -1;
    std::vector<ScreenSide> sides;
    for (const PieceEdge& edge : edgesOf(mesh, piece)) {
        const glm::dvec2 from = mesh.vertices[piece.vertices[edge.from]].s;
        const glm::dvec2 along = glm::normalize(mesh.vertices[piece.vertices[edge.to]].s - from) * turn;
        sides.push_back({from, {-along.y, along.x}});
    }
    return sides;
}

}  // namespace

glm::dvec2 snapToGrid(glm::dvec2 px) {
    return {std::round(px.x / kSnapPx) * kSnapPx, std::round(px.y / kSnapPx) * kSnapPx};
}

glm::dmat3 homographyThrough(const PieceVertex& a, const PieceVertex& b, const PieceVertex& c) {
    return glm::dmat3(glm::dvec3(a.s, 1), glm::dvec3(b.s, 1), glm::dvec3(c.s, 1)) *
           glm::inverse(glm::dmat3(a.m, b.m, c.m));
}

std::array<PieceVertex, 3> widestTriangle(const PieceMesh& mesh, const Piece& piece) {
    const auto vertex = [&](uint32_t i) -> const PieceVertex& { return mesh.vertices[piece.vertices[i]]; };
    std::array<uint32_t, 3> widest{0, 1, 2};
    double largest = 0;
    for (uint32_t i = 0; i < piece.vertexCount && piece.vertexCount > 3; ++i) {
        for (uint32_t j = i + 1; j < piece.vertexCount; ++j) {
            for (uint32_t k = j + 1; k < piece.vertexCount; ++k) {
                const double area = std::abs(doubleArea(vertex(i).s, vertex(j).s, vertex(k).s));
                if (area <= largest) continue;
                largest = area;
                widest = {i, j, k};
            }
        }
    }
    return {vertex(widest[0]), vertex(widest[1]), vertex(widest[2])};
}

void updateHomographies(PieceMesh& mesh) {
    for (Piece& piece : mesh.pieces) {
        const auto [a, b, c] = widestTriangle(mesh, piece);
        piece.screenFromRay = homographyThrough(a, b, c);
    }
}

bool isExactQuad(const PieceVertex& a, const PieceVertex& b, const PieceVertex& c, const PieceVertex& d) {
    const double largestM =
        std::max({glm::length(a.m), glm::length(b.m), glm::length(c.m), glm::length(d.m)});
    return glm::length(a.m - b.m + c.m - d.m) <= kRounding * largestM &&
           a.s - b.s + c.s - d.s == glm::dvec2(0);
}

namespace {

// Vertex indices around the cell of a grid.
std::array<uint32_t, 4> cellCorners(const PieceGrid& grid, int column, int row) {
    const auto a = static_cast<uint32_t>(row * (grid.columns + 1) + column);
    const uint32_t d = a + static_cast<uint32_t>(grid.columns) + 1;
    return {a, a + 1, d + 1, d};
}

}  // namespace

bool isQuadGrid(const PieceGrid& grid) {
    for (int row = 0; row < grid.rows; ++row) {
        for (int column = 0; column < grid.columns; ++column) {
            const auto [a, b, c, d] = cellCorners(grid, column, row);
            if (!isExactQuad(grid.vertices[a], grid.vertices[b], grid.vertices[c], grid.vertices[d]))
                return false;
        }
    }
    return true;
}

PieceMesh meshFromGrid(const PieceGrid& grid, bool quads) {
    PieceMesh mesh{grid.sizePx, grid.vertices, {}};
    const auto addPiece = [&](std::initializer_list<uint32_t> corners) {
        Piece piece;
        for (uint32_t corner : corners) piece.vertices[piece.vertexCount++] = corner;
        mesh.pieces.push_back(piece);
    };
    for (int row = 0; row < grid.rows; ++row) {
        for (int column = 0; column < grid.columns; ++column) {
            const auto [a, b, c, d] = cellCorners(grid, column, row);
            if (quads) {
                addPiece({a, b, c, d});
            } else {
                addPiece({a, b, c});
                addPiece({a, c, d});
            }
        }
    }
    updateHomographies(mesh);
    return mesh;
}

std::vector<PieceEdge> edgesOf(const PieceMesh& mesh, const Piece& piece) {
    std::vector<PieceEdge> edges;
    for (uint32_t from = 0; from < piece.vertexCount; ++from) {
        const uint32_t to = (from + 1) % piece.vertexCount;
        if (glm::distance(mesh.vertices[piece.vertices[from]].s, mesh.vertices[piece.vertices[to]].s) >
            kNoLengthPx)
            edges.push_back({from, to});
    }
    return edges;
}

bool isOnBorder(const PieceMesh& mesh, const Piece& piece, PieceEdge edge) {
    const glm::dvec2 a = mesh.vertices[piece.vertices[edge.from]].s,
                     b = mesh.vertices[piece.vertices[edge.to]].s;
    for (int axis = 0; axis < 2; ++axis)
        if (a[axis] == b[axis] && (a[axis] <= 0 || a[axis] >= mesh.sizePx[axis])) return true;
    return false;
}

std::vector<glm::dvec3> edgePlanes(const PieceMesh& mesh, const Piece& piece, double guardPx) {
    // A screen line is a plane through the eye: (n, c) . H r >= 0, that is (H^T (n, c)) . r >= 0.
    std::vector<glm::dvec3> planes;
    for (const ScreenSide& side : screenSides(mesh, piece))
        planes.push_back(glm::transpose(piece.screenFromRay) *
                         glm::dvec3(side.inward, guardPx - glm::dot(side.inward, side.from)));
    return planes;
}

std::vector<glm::dvec3> guardedCorners(const PieceMesh& mesh, const Piece& piece, double guardPx) {
    const std::vector<ScreenSide> sides = screenSides(mesh, piece);
    const glm::dmat3 rayFromScreen = glm::inverse(piece.screenFromRay);
    std::vector<glm::dvec3> corners;
    for (size_t i = 0; i < sides.size(); ++i) {
        // Where the two guarded lines cross, in a form that holds for sides in one line too.
        const glm::dvec2 before = sides[(i + sides.size() - 1) % sides.size()].inward,
                         after = sides[i].inward;
        const glm::dvec2 outward = -(before + after) / (1 + glm::dot(before, after));
        corners.push_back(rayFromScreen * glm::dvec3(sides[i].from + guardPx * outward, 1));
    }
    return corners;
}

}  // namespace curvewall
