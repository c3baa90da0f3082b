#include "renderer/gpu_pieces.h"

#include "calibration/errors.h"
#include "calibration/pieces/ownership.h"
#include "calibration/pieces/piece_tree.h"
#include "renderer/node_grid.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vec4.hpp>

#include <algorithm>
#include <string>

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

std::vector<GpuConeNode> gpuNodes(std::span<const ConeNode> tree) {
    std::vector<GpuConeNode> nodes;
    for (const ConeNode& node : tree) {
        GpuConeNode& gpu = nodes.emplace_back();
        for (size_t i = 0; i < kMostPieceEdges; ++i) gpu.planes[i] = glm::vec4(glm::vec3(node.planes[i]), 0);
        gpu.link = {node.next, static_cast<uint32_t>(node.piece), node.planeCount, 0};
    }
    return nodes;
}

// As shaders/grid_lookup.glsl reads them.
struct GpuGridPlane {
    glm::vec4 right, down, ahead;
    glm::vec2 least, cellsPerUnit;
};
struct GpuGridHeader {
    std::array<GpuGridPlane, kMostGridPlanes> planes{};
    int32_t planeCount = 0, width = 0, cellsOfPlane = 0, reserved = 0;
};
static_assert(sizeof(GpuGridHeader) == kMostGridPlanes * 64 + 16);

GlBuffer gpuGrid(const NodeGrid& grid) {
    const auto axis = [](glm::dvec3 direction) { return glm::vec4(glm::vec3(direction), 0); };
    GpuGridHeader header{{}, static_cast<int32_t>(grid.planes.size()), grid.width, cellsOfPlane(grid.width)};
    std::ranges::transform(grid.planes, header.planes.begin(), [&](const GridPlane& plane) {
        return GpuGridPlane{axis(plane.right), axis(plane.down), axis(plane.ahead), plane.least,
                            plane.cellsPerUnit};
    });
    const size_t rangeBytes = grid.ranges.size() * sizeof grid.ranges[0];
    GlBuffer buffer = makeBuffer(nullptr, sizeof header + rangeBytes, GL_DYNAMIC_STORAGE_BIT);
    glNamedBufferSubData(buffer.id(), 0, sizeof header, &header);
    glNamedBufferSubData(buffer.id(), sizeof header, static_cast<GLsizeiptr>(rangeBytes), grid.ranges.data());
    return buffer;
}

std::vector<glm::vec4> guardedCornersOfAll(const PieceMesh& mesh, double guardPx) {
    std::vector<glm::vec4> corners;
    for (const Piece& piece : mesh.pieces) {
        const std::vector<glm::dvec3> ofPiece = guardedCorners(mesh, piece, guardPx);
        for (size_t i = 0; i < kMostPieceEdges; ++i)
            corners.emplace_back(glm::vec3(glm::normalize(ofPiece[std::min(i, ofPiece.size() - 1)])), 0);
    }
    return corners;
}

constexpr size_t kMostOwnerBytes = size_t{1} << 29;

GpuOwners makeOwners(glm::ivec2 sizePx, int layers) {
    GLuint id = 0;
    glCreateTextures(GL_TEXTURE_2D_ARRAY, 1, &id);
    GpuOwners gpu{GlTexture(id), {}, 0};
    glTextureStorage3D(id, 1, GL_R32I, sizePx.x, sizePx.y, layers);
    // Whole numbers are not mixed.
    glTextureParameteri(id, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTextureParameteri(id, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    return gpu;
}

// Tiles that have holes, those beside each other as one.
std::vector<glm::ivec4> holeTilesOf(const std::vector<int32_t>& owners, glm::ivec2 sizePx) {
    constexpr int kTilePx = 32;
    const auto hasHole = [&](glm::ivec4 tile) {
        for (int y = tile.y; y < tile.w; ++y) {
            const auto row = owners.begin() + std::ptrdiff_t{y} * sizePx.x;
            if (std::find(row + tile.x, row + tile.z, kNoPiece) != row + tile.z) return true;
        }
        return false;
    };
    std::vector<glm::ivec4> tiles;
    for (int y = 0; y < sizePx.y; y += kTilePx) {
        bool goesOn = false;
        for (int x = 0; x < sizePx.x; x += kTilePx) {
            const glm::ivec4 tile(x, y, std::min(x + kTilePx, sizePx.x), std::min(y + kTilePx, sizePx.y));
            const bool has = hasHole(tile);
            if (has && goesOn)
                tiles.back().z = tile.z;
            else if (has)
                tiles.push_back(tile);
            goesOn = has;
        }
    }
    return tiles;
}

void fillLayer(GpuOwners& gpu, int layer, const std::vector<int32_t>& owners, glm::ivec2 sizePx) {
    glTextureSubImage3D(gpu.texture.id(), 0, 0, 0, layer, sizePx.x, sizePx.y, 1, GL_RED_INTEGER, GL_INT,
                        owners.data());
}

}  // namespace

GpuPieces uploadPieces(const PieceMesh& mesh, double guardPx) {
    GpuPieces gpu;
    gpu.sizePx = mesh.sizePx;
    gpu.pieceCount = static_cast<int>(mesh.pieces.size());
    for (const Piece& piece : mesh.pieces)
        gpu.clipPlanes = std::max(gpu.clipPlanes, static_cast<int>(innerEdgePlanes(mesh, piece).size()));
    for (const Piece& piece : mesh.pieces)
        gpu.frontIsClockwise.push_back(glm::determinant(piece.screenFromRay) > 0);
    const std::vector<glm::vec4> rows = pieceRows(mesh, static_cast<size_t>(gpu.clipPlanes));
    gpu.rows = {{glm::vec3(rows[0]), glm::vec3(rows[1]), glm::vec3(rows[2])}};
    gpu.pieces = makeBuffer(std::span<const glm::vec4>(rows));
    const std::vector<ConeNode> tree = buildPieceTree(mesh, guardPx);
    const std::vector<GpuConeNode> nodes = gpuNodes(tree);
    gpu.nodeCount = static_cast<uint32_t>(nodes.size());
    gpu.nodes = makeBuffer(std::span<const GpuConeNode>(nodes));
    gpu.nodeGrid = gpuGrid(buildNodeGrid(mesh, tree, guardPx));
    gpu.corners = makeBuffer(std::span<const glm::vec4>(guardedCornersOfAll(mesh, guardPx)));
    return gpu;
}

GpuPieces uploadLayers(std::span<const PieceMesh> layers) {
    GpuPieces gpu;
    gpu.sizePx = layers.front().sizePx;
    gpu.pieceCount = static_cast<int>(layers.size());
    std::vector<glm::vec4> all;
    for (const PieceMesh& layer : layers) {
        gpu.frontIsClockwise.push_back(glm::determinant(layer.pieces.front().screenFromRay) > 0);
        const std::vector<glm::vec4> rows = pieceRows(layer, 0);
        gpu.rows.push_back({glm::vec3(rows[0]), glm::vec3(rows[1]), glm::vec3(rows[2])});
        all.insert(all.end(), rows.begin(), rows.end());
    }
    gpu.pieces = makeBuffer(std::span<const glm::vec4>(all));
    return gpu;
}

glm::vec4 sampleGridOf(const GpuPieces& pieces, const FramePass& pass) {
    if (pass.samples > 1) return glm::vec4(0);
    const glm::vec2 half = 0.5f * glm::vec2(pieces.sizePx);
    return {half, half - 0.5f + pass.shiftPx};
}

GpuOwners uploadOwners(const std::vector<int32_t>& owners, glm::ivec2 sizePx) {
    GpuOwners gpu = makeOwners(sizePx, 1);
    fillLayer(gpu, 0, owners, sizePx);
    const std::vector<glm::ivec4> tiles = holeTilesOf(owners, sizePx);
    gpu.holeTiles = makeBuffer(std::span<const glm::ivec4>(tiles));
    gpu.holeTileCount = static_cast<int>(tiles.size());
    return gpu;
}

GpuOwners uploadSampleOwners(const PieceMesh& mesh, std::span<const glm::dvec2> offsetsPx) {
    GLint mostLayers = 0;
    glGetIntegerv(GL_MAX_ARRAY_TEXTURE_LAYERS, &mostLayers);
    const auto pixels = static_cast<size_t>(mesh.sizePx.x) * static_cast<size_t>(mesh.sizePx.y);
    const size_t most =
        std::min(static_cast<size_t>(mostLayers), kMostOwnerBytes / (pixels * sizeof(int32_t)));
    if (offsetsPx.size() > most)
        throw UsageError("with transparent surfaces a display of " + std::to_string(mesh.sizePx.x) + " x " +
                         std::to_string(mesh.sizePx.y) + " px may have at most " + std::to_string(most) +
                         " samples a pixel, not " + std::to_string(offsetsPx.size()));
    GpuOwners gpu = makeOwners(mesh.sizePx, static_cast<int>(offsetsPx.size()));
    for (size_t i = 0; i < offsetsPx.size(); ++i)
        fillLayer(gpu, static_cast<int>(i), ownerImage(mesh, offsetsPx[i]), mesh.sizePx);
    return gpu;
}

size_t memoryBytesOf(const GpuPieces& pieces) {
    return sizeOf(pieces.pieces) + sizeOf(pieces.nodes) + sizeOf(pieces.nodeGrid) + sizeOf(pieces.corners);
}

size_t memoryBytesOf(const GpuOwners& owners) { return sizeOf(owners.texture) + sizeOf(owners.holeTiles); }

}  // namespace curvewall
