#include "renderer/tessellation_replicator.h"

#include "renderer/piece_coverage.h"

#include <algorithm>

namespace curvewall {
namespace {

constexpr int kMostPoints = 64 * 65;  // of one patch; see tessellated.glsl

}  // namespace

TessellationReplicator::TessellationReplicator(std::span<const SceneChunk> chunks)
    : chunks_(chunks), emptyVertexArray_(makeVertexArray()) {}

void TessellationReplicator::draw(const PieceDraw& draw) {
    glBindVertexArray(emptyVertexArray_.id());
    glPatchParameteri(GL_PATCH_VERTICES, 1);
    const int patchesATriangle = (draw.pieces.pieceCount + kMostPoints - 1) / kMostPoints;
    draw.timer.begin("surfaces");
    pairQueries_.begin();
    for (const SceneChunk& chunk : chunks_) {
        bindForCoverage(chunk, draw.pieces);
        draw.materials.bindPulled(chunk);
        for (const ChunkRange& range : chunk.ranges) {
            const GLuint program = draw.materials.bind(range.material);
            setForCoverage(program, draw.pieces, sampleGridOf(draw.pieces, draw.pass));
            glProgramUniform1ui(program, 20, static_cast<GLuint>(patchesATriangle));
            glDrawArrays(GL_PATCHES, patchesATriangle * static_cast<GLint>(range.firstTriangle),
                         patchesATriangle * static_cast<GLsizei>(range.triangleCount));
        }
    }
    pairQueries_.end();
}

FrameOutcome TessellationReplicator::finishFrame() {
    const std::vector<uint64_t> counts = pairQueries_.take();
    return {.pairCount = counts.empty() ? 0 : std::ranges::max(counts)};
}

}  // namespace curvewall
