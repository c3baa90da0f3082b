#pragma once
// A piece mesh in GPU memory, in the layouts of scene.vert and coverage.comp.

#include "calibration/pieces/piece_mesh.h"
#include "renderer/gl/gl_objects.h"

namespace curvewall {

// What is nearer to the eye than this fraction of the distance to the wall is cut, in every method.
inline constexpr float kNearFraction = 1e-5f;

struct GpuPieces {
    glm::ivec2 sizePx{0};
    int pieceCount = 0;
    int clipPlanes = 0;             // planes a piece is clipped by; edges on the display's border need none
    bool frontIsClockwise = false;  // of a single piece: how triangles seen from the front turn on the screen
    GlBuffer pieces;                // three rows of H to clip space, then clipPlanes planes, each a vec4
    uint32_t nodeCount = 0;
    GlBuffer nodes;  // the piece tree
};

// `guardPx` is how far beyond its edges the tree still finds a piece.
GpuPieces uploadPieces(const PieceMesh& mesh, double guardPx = kGuardPx);

// The owner of every pixel; see calibration/pieces/ownership.h.
struct GpuOwners {
    GlTexture texture;  // R32I
    bool hasHoles = false;
};

GpuOwners uploadOwners(const std::vector<int32_t>& owners, glm::ivec2 sizePx);

}  // namespace curvewall
