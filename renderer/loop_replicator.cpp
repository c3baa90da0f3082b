#include "renderer/loop_replicator.h"

namespace curvewall {

void LoopReplicator::draw(const PieceDraw& draw) {
    pairCount_ = 0;
    bindStorage(2, draw.pieces.pieces);
    for (const SceneChunk& chunk : chunks_) {
        glBindVertexArray(chunk.vertexArray.id());
        for (int piece = 0; piece < draw.pieces.pieceCount; ++piece) {
            for (const ChunkRange& range : chunk.ranges) {
                const GLuint program = draw.materials.bind(range.material);
                glProgramUniform1i(program, 18, piece);
                draw.materials.programs.setFacing(program,
                                                  draw.pieces.frontIsClockwise[static_cast<size_t>(piece)]);
                glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(3 * range.triangleCount), GL_UNSIGNED_INT,
                               reinterpret_cast<const void*>(size_t{12} * range.firstTriangle));
                pairCount_ += range.triangleCount;
            }
        }
    }
}

FrameOutcome LoopReplicator::finishFrame() { return {pairCount_, false}; }

}  // namespace curvewall
