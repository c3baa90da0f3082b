#include "calibration/pieces/ownership.h"

#include <algorithm>
#include <cmath>

namespace curvewall {
namespace {

// Screen positions in units of 1/256 px. Displays are at most 16384 px wide, so products stay below 2^46.
struct GridPoint {
    int64_t x, y;
};

constexpr int64_t kUnitsPerPx = 256;

GridPoint gridPoint(glm::dvec2 px) { return {std::llround(px.x / kSnapPx), std::llround(px.y / kSnapPx)}; }

// Twice the area to the inner side of an edge, for a polygon that turns positively with y down.
struct Edge {
    GridPoint from;
    int64_t dx, dy;

    bool isTopOrLeft() const { return dy < 0 || (dy == 0 && dx > 0); }
    bool owns(GridPoint p) const {
        const int64_t inside = dx * (p.y - from.y) - dy * (p.x - from.x);
        return inside > 0 || (inside == 0 && isTopOrLeft());
    }
};

struct Polygon {
    std::array<Edge, kMostPieceEdges> edges;
    size_t edgeCount = 0;
    GridPoint least{INT64_MAX, INT64_MAX}, most{INT64_MIN, INT64_MIN};

    bool owns(GridPoint p) const {
        return std::all_of(edges.begin(), edges.begin() + static_cast<std::ptrdiff_t>(edgeCount),
                           [&](const Edge& edge) { return edge.owns(p); });
    }
};

Polygon polygonOf(const PieceMesh& mesh, const Piece& piece) {
    std::vector<GridPoint> corners;
    for (uint32_t i = 0; i < piece.vertexCount; ++i)
        corners.push_back(gridPoint(mesh.vertices[piece.vertices[i]].s));
    const GridPoint a = corners[0], b = corners[1], c = corners[2];
    if ((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x) < 0) std::ranges::reverse(corners);

    Polygon polygon;
    for (size_t i = 0; i < corners.size(); ++i) {
        const GridPoint from = corners[i], to = corners[(i + 1) % corners.size()];
        polygon.edges[polygon.edgeCount++] = {from, to.x - from.x, to.y - from.y};
        polygon.least = {std::min(polygon.least.x, from.x), std::min(polygon.least.y, from.y)};
        polygon.most = {std::max(polygon.most.x, from.x), std::max(polygon.most.y, from.y)};
    }
    return polygon;
}

}  // namespace

std::vector<int32_t> ownerImage(const PieceMesh& mesh) {
    const int64_t width = mesh.sizePx.x, height = mesh.sizePx.y;
    std::vector<int32_t> owners(static_cast<size_t>(width * height), kNoPiece);
    for (size_t k = 0; k < mesh.pieces.size(); ++k) {
        const Polygon polygon = polygonOf(mesh, mesh.pieces[k]);
        const int64_t firstX = std::max<int64_t>(0, polygon.least.x / kUnitsPerPx - 1);
        const int64_t firstY = std::max<int64_t>(0, polygon.least.y / kUnitsPerPx - 1);
        const int64_t endX = std::min(width, polygon.most.x / kUnitsPerPx + 1);
        const int64_t endY = std::min(height, polygon.most.y / kUnitsPerPx + 1);
        for (int64_t y = firstY; y < endY; ++y)
            for (int64_t x = firstX; x < endX; ++x)
                if (polygon.owns({x * kUnitsPerPx + kUnitsPerPx / 2, y * kUnitsPerPx + kUnitsPerPx / 2}))
                    owners[static_cast<size_t>(y * width + x)] = static_cast<int32_t>(k);
    }
    return owners;
}

}  // namespace curvewall
