#pragma once
// A piece mesh in GPU memory, in the layouts of scene.vert and coverage.comp.

#include "calibration/pieces/piece_mesh.h"
#include "renderer/frame_pass.h"
#include "renderer/gl/gl_objects.h"

#include <glm/vec4.hpp>

#include <array>
#include <span>
#include <vector>

namespace curvewall {

// What is nearer to the eye than this fraction of the distance to the wall is cut, in every method.
inline constexpr float kNearFraction = 1e-5f;

struct GpuPieces {
    glm::ivec2 sizePx{0};
    int pieceCount = 0;
    int clipPlanes = 0;  // planes a piece is clipped by; edges on the display's border need none
    std::vector<bool>
        frontIsClockwise;  // of each piece: how triangles seen from the front turn on the screen
    std::vector<std::array<glm::vec3, 3>> rows;  // H to clip space: of the first piece, or of every layer
    GlBuffer pieces;  // three rows of H to clip space, then clipPlanes planes, each a vec4
    uint32_t nodeCount = 0;
    GlBuffer nodes;     // the piece tree
    GlBuffer nodeGrid;  // see node_grid.h
    GlBuffer corners;   // six rays a piece with its guard, the last one repeated, each a vec4
};

// `guardPx` is how far beyond its edges the tree still finds a piece.
GpuPieces uploadPieces(const PieceMesh& mesh, double guardPx = kGuardPx);

// Meshes of one piece each, for pictures that are drawn at once into the layers of a target. Only for
// CornerSource::layered; `sizePx` is the first one's.
GpuPieces uploadLayers(std::span<const PieceMesh> layers);

// Scale and offset that make clip space whole numbers at the samples of a pass; zeros where it has several a
// pixel.
glm::vec4 sampleGridOf(const GpuPieces& pieces, const FramePass& pass);

// The owner of every pixel, or of every sample of every pixel; see calibration/pieces/ownership.h.
struct GpuOwners {
    GlTexture texture;  // an array of R32I, one layer a sample
    GlBuffer
        holeTiles;  // of pixels' owners: left, top, right and bottom of the tiles that have holes, pixels
    int holeTileCount = 0;

    bool hasHoles() const { return holeTileCount > 0; }
};

// Of the pixels' centres.
GpuOwners uploadOwners(const std::vector<int32_t>& owners, glm::ivec2 sizePx);

// Of samples that lie at `offsetsPx` from their pixel's top left corner. Throws UsageError where they would
// take too much memory.
GpuOwners uploadSampleOwners(const PieceMesh& mesh, std::span<const glm::dvec2> offsetsPx);

size_t memoryBytesOf(const GpuPieces& pieces);
size_t memoryBytesOf(const GpuOwners& owners);

}  // namespace curvewall
