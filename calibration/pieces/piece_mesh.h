#pragma once
// The pieces of one display: a faceted screen seen from the eye.
//
// A vertex is a point m (metres, wall axes, eye at the origin) and a screen position s (pixels). A piece is a
// convex facet over such vertices that maps affinely to the screen, so a ray r lands on the screen by one
// homography H with H m_i = (s_i, 1). Facets share edges, hence neighbours agree along them whatever the m.
// The affine camera texture triangles and the cylinder slices of Lorenz and Doellner (2009), section 3, are
// both facets of this kind.

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace curvewall {

// Screen positions are whole multiples of this, so that ownership can be decided in integers.
inline constexpr double kSnapPx = 1.0 / 256;

// Clipping leaves this much beyond a piece's edges. Neighbours agree there to a small part of the tolerance,
// and no rounding in the rasterizer can open a gap.
inline constexpr double kGuardPx = 0.25;

// Pieces are clipped by one plane an edge, and drivers offer eight.
inline constexpr uint32_t kMostPieceEdges = 6;

struct PieceVertex {
    glm::dvec3 m;
    glm::dvec2 s;
};

// A convex polygon, vertices in order around it. All its m are one affine map of its s, to rounding. Some of
// its vertices may lie within what is one side, where neighbours have corners, or at one place.
struct Piece {
    std::array<uint32_t, kMostPieceEdges> vertices{};
    uint32_t vertexCount = 0;
    glm::dmat3 screenFromRay{1};  // H: (x, y, w) with w = 1 on the facet; behind the eye w is negative
};

struct PieceMesh {
    glm::ivec2 sizePx{0};
    std::vector<PieceVertex> vertices;
    std::vector<Piece> pieces;
};

glm::dvec2 snapToGrid(glm::dvec2 px);

// H of the facet through three vertices.
glm::dmat3 homographyThrough(const PieceVertex& a, const PieceVertex& b, const PieceVertex& c);

// The three vertices of a piece that span the largest triangle on the screen, which tell its plane best.
std::array<PieceVertex, 3> widestTriangle(const PieceMesh& mesh, const Piece& piece);

// H of every piece, from its vertices.
void updateHomographies(PieceMesh& mesh);

// True when four vertices, in order around a cell, are corners of parallelograms in space and on the screen,
// to rounding: then they lie in one plane and map by one affine map.
bool isExactQuad(const PieceVertex& a, const PieceVertex& b, const PieceVertex& c, const PieceVertex& d);

// (columns + 1) x (rows + 1) vertices, row by row from the top left.
struct PieceGrid {
    glm::ivec2 sizePx{0};
    int columns = 0;
    int rows = 0;
    std::vector<PieceVertex> vertices;
};

// True when every cell is an exact quad.
bool isQuadGrid(const PieceGrid& grid);

// One piece a cell for a grid of exact quads, otherwise two triangles a cell.
PieceMesh meshFromGrid(const PieceGrid& grid, bool quads);

// An edge of a piece, as places in its list of vertices.
struct PieceEdge {
    uint32_t from, to;
};

// The edges that have a length, in order around the piece.
std::vector<PieceEdge> edgesOf(const PieceMesh& mesh, const Piece& piece);

// Whether an edge lies on the display's border.
bool isOnBorder(const PieceMesh& mesh, const Piece& piece, PieceEdge edge);

// Planes through the eye that bound a piece, its guard included: dot(plane, ray) >= 0 inside. One for each of
// edgesOf.
std::vector<glm::dvec3> edgePlanes(const PieceMesh& mesh, const Piece& piece, double guardPx = kGuardPx);

// Corner rays of the region that edgePlanes bounds.
std::vector<glm::dvec3> guardedCorners(const PieceMesh& mesh, const Piece& piece, double guardPx = kGuardPx);

}  // namespace curvewall
