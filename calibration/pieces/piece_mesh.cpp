#include "calibration/pieces/piece_mesh.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>

namespace curvewall {
namespace {

constexpr double kRounding = 1e-12;  // of the largest coordinate

// Lines (n, c) on the screen with n of length one and dot(n, p) + c >= 0 inside the piece and its guard.
std::vector<glm::dvec3> guardedScreenLines(const PieceMesh& mesh, const Piece& piece) {
    const auto corner = [&](uint32_t i) { return mesh.vertices[piece.vertices[i % piece.vertexCount]].s; };
    const glm::dvec2 u = corner(1) - corner(0), v = corner(2) - corner(0);
    const double turn = u.x * v.y - u.y * v.x > 0 ? 1 : -1;
    std::vector<glm::dvec3> lines;
    for (uint32_t i = 0; i < piece.vertexCount; ++i) {
        const glm::dvec2 along = glm::normalize(corner(i + 1) - corner(i)) * turn;
        const glm::dvec2 inward(-along.y, along.x);
        lines.emplace_back(inward, kGuardPx - glm::dot(inward, corner(i)));
    }
    return lines;
}

}  // namespace

glm::dvec2 snapToGrid(glm::dvec2 px) {
    return {std::round(px.x / kSnapPx) * kSnapPx, std::round(px.y / kSnapPx) * kSnapPx};
}

glm::dmat3 homographyThrough(const PieceVertex& a, const PieceVertex& b, const PieceVertex& c) {
    return glm::dmat3(glm::dvec3(a.s, 1), glm::dvec3(b.s, 1), glm::dvec3(c.s, 1)) *
           glm::inverse(glm::dmat3(a.m, b.m, c.m));
}

void updateHomographies(PieceMesh& mesh) {
    for (Piece& piece : mesh.pieces) {
        const auto vertex = [&](uint32_t i) { return mesh.vertices[piece.vertices[i]]; };
        piece.screenFromRay = homographyThrough(vertex(0), vertex(1), vertex(2));
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

std::vector<glm::dvec3> edgePlanes(const PieceMesh& mesh, const Piece& piece) {
    // A screen line is a plane through the eye: (n, c) . H r >= 0, that is (H^T (n, c)) . r >= 0.
    std::vector<glm::dvec3> planes;
    for (const glm::dvec3& line : guardedScreenLines(mesh, piece))
        planes.push_back(glm::transpose(piece.screenFromRay) * line);
    return planes;
}

std::vector<glm::dvec3> guardedCorners(const PieceMesh& mesh, const Piece& piece) {
    const std::vector<glm::dvec3> lines = guardedScreenLines(mesh, piece);
    const glm::dmat3 rayFromScreen = glm::inverse(piece.screenFromRay);
    std::vector<glm::dvec3> corners;
    for (size_t i = 0; i < lines.size(); ++i) {
        const glm::dvec3 crossing = glm::cross(lines[(i + lines.size() - 1) % lines.size()], lines[i]);
        corners.push_back(rayFromScreen * (crossing / crossing.z));
    }
    return corners;
}

}  // namespace curvewall
