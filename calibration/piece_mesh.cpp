#include "calibration/piece_mesh.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <cmath>

namespace curvewall {
namespace {

constexpr double kExactPx = 1e-9;

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

bool isExactQuad(const PieceVertex& a, const PieceVertex& b, const PieceVertex& c, const PieceVertex& d) {
    const glm::dvec3 h = homographyThrough(a, b, c) * d.m;
    return std::abs(h.z - 1) < kExactPx && glm::length(glm::dvec2(h) - d.s) < kExactPx;
}

PieceMesh meshFromGrid(glm::ivec2 sizePx, std::vector<PieceVertex> vertices, int columns, int rows) {
    PieceMesh mesh{sizePx, std::move(vertices), {}};
    const auto addPiece = [&](std::initializer_list<uint32_t> corners) {
        Piece piece;
        for (uint32_t corner : corners) piece.vertices[piece.vertexCount++] = corner;
        const auto vertex = [&](uint32_t i) { return mesh.vertices[piece.vertices[i]]; };
        piece.screenFromRay = homographyThrough(vertex(0), vertex(1), vertex(2));
        mesh.pieces.push_back(piece);
    };
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) {
            const auto a = static_cast<uint32_t>(row * (columns + 1) + column);
            const uint32_t b = a + 1, d = a + static_cast<uint32_t>(columns) + 1, c = d + 1;
            if (isExactQuad(mesh.vertices[a], mesh.vertices[b], mesh.vertices[c], mesh.vertices[d])) {
                addPiece({a, b, c, d});
            } else {
                addPiece({a, b, c});
                addPiece({a, c, d});
            }
        }
    }
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
