#include "renderer/tessellation_replicator.h"

#include "calibration/errors.h"
#include "renderer/piece_coverage.h"

#include <string>

namespace curvewall {
namespace {

constexpr int kMostPoints = 64 * 65;  // of one triangle; see tessellated.glsl
// A geometry shader may bring forth 1024 components, and a corner has up to 25.
constexpr int kMostReplicationsAPoint = 13;

}  // namespace

int replicationsAPoint(int pieceCount) {
    const int needed = (pieceCount + kMostPoints - 1) / kMostPoints;
    if (needed > kMostReplicationsAPoint)
        throw UsageError("the tessellation engine replicates a triangle " +
                         std::to_string(kMostPoints * kMostReplicationsAPoint) +
                         " times at most, and the display has " + std::to_string(pieceCount) + " pieces");
    return needed;
}

TessellationReplicator::TessellationReplicator(std::span<const SceneChunk> chunks)
    : chunks_(chunks), emptyVertexArray_(makeVertexArray()) {}

void TessellationReplicator::draw(const PieceDraw& draw) {
    glBindVertexArray(emptyVertexArray_.id());
    glPatchParameteri(GL_PATCH_VERTICES, 1);
    pairQueries_.begin();
    for (const SceneChunk& chunk : chunks_) {
        bindForCoverage(chunk, draw.pieces);
        bindStorage(3, chunk.normals);
        bindStorage(4, chunk.uvs);
        for (const ChunkRange& range : chunk.ranges) {
            setForCoverage(draw.materials.bind(range.material), draw.pieces, draw.pass);
            glDrawArrays(GL_PATCHES, static_cast<GLint>(range.firstTriangle),
                         static_cast<GLsizei>(range.triangleCount));
        }
    }
    pairQueries_.end();
}

FrameOutcome TessellationReplicator::finishFrame() {
    // A frame may have several passes. Its pairs are those of one.
    const std::vector<uint64_t> counts = pairQueries_.take();
    return {counts.empty() ? 0 : counts.back(), false};
}

}  // namespace curvewall
