#include "renderer/gpu_pieces.h"

#include "calibration/pieces/ownership.h"
#include "calibration/pieces/piece_tree.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vec4.hpp>

#include <algorithm>

namespace curvewall {
namespace {

struct GpuConeNode {
    glm::vec4 planes[kMostPieceEdges];
    glm::uvec4 link;
};
static_assert(sizeof(GpuConeNode) == 112);

// Edge planes that the display's own border does not already clip by.
std::vector<glm::dvec3> innerEdgePlanes(const PieceMesh& mesh, const Piece& piece) {
    const std::vector<glm::dvec3> all = edgePlanes(mesh, piece);
    std::vector<glm::dvec3> inner;
    const std::vector<PieceEdge> edges = edgesOf(mesh, piece);
    for (size_t i = 0; i < edges.size(); ++i)
        if (!isOnBorder(mesh, piece, edges[i])) inner.push_back(all[i]);
    return inner;
}

std::vector<glm::vec4> pieceRows(const PieceMesh& mesh, size_t clipPlanes) {
    // Pixels to clip space; the picture's row 0 is the framebuffer's row 0, so that nothing is ever flipped.
    const glm::dmat3 clipFromScreen(2.0 / mesh.sizePx.x, 0, 0, 0, 2.0 / mesh.sizePx.y, 0, -1, -1, 1);
    std::vector<glm::vec4> rows;
    for (const Piece& piece : mesh.pieces) {
        const glm::dmat3 transposed = glm::transpose(clipFromScreen * piece.screenFromRay);
        for (int i = 0; i < 3; ++i) rows.emplace_back(glm::vec3(transposed[i]), 0);
        const std::vector<glm::dvec3> planes = innerEdgePlanes(mesh, piece);
        // A piece with fewer inner edges repeats one, or has none and clips by w > 0.
        for (size_t i = 0; i < clipPlanes; ++i)
            rows.emplace_back(
                glm::vec3(planes.empty() ? transposed[2] : planes[std::min(i, planes.size() - 1)]), 0);
    }
    return rows;
}

std::vector<GpuConeNode> gpuNodes(const PieceMesh& mesh, double guardPx) {
    std::vector<GpuConeNode> nodes;
    for (const ConeNode& node : buildPieceTree(mesh, guardPx)) {
        GpuConeNode& gpu = nodes.emplace_back();
        for (size_t i = 0; i < kMostPieceEdges; ++i) gpu.planes[i] = glm::vec4(glm::vec3(node.planes[i]), 0);
        gpu.link = {node.next, static_cast<uint32_t>(node.piece), node.planeCount, 0};
    }
    return nodes;
}

}  // namespace

GpuPieces uploadPieces(const PieceMesh& mesh, double guardPx) {
    GpuPieces gpu;
    gpu.sizePx = mesh.sizePx;
    gpu.pieceCount = static_cast<int>(mesh.pieces.size());
    for (const Piece& piece : mesh.pieces)
        gpu.clipPlanes = std::max(gpu.clipPlanes, static_cast<int>(innerEdgePlanes(mesh, piece).size()));
    gpu.frontIsClockwise = glm::determinant(mesh.pieces.front().screenFromRay) > 0;
    gpu.pieces = makeBuffer(std::span<const glm::vec4>(pieceRows(mesh, static_cast<size_t>(gpu.clipPlanes))));
    const std::vector<GpuConeNode> nodes = gpuNodes(mesh, guardPx);
    gpu.nodeCount = static_cast<uint32_t>(nodes.size());
    gpu.nodes = makeBuffer(std::span<const GpuConeNode>(nodes));
    return gpu;
}

GpuOwners uploadOwners(const std::vector<int32_t>& owners, glm::ivec2 sizePx) {
    GpuOwners gpu{makeTexture2D(GL_R32I, sizePx), std::ranges::find(owners, kNoPiece) != owners.end()};
    glTextureSubImage2D(gpu.texture.id(), 0, 0, 0, sizePx.x, sizePx.y, GL_RED_INTEGER, GL_INT, owners.data());
    return gpu;
}

}  // namespace curvewall
