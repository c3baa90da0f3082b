#include "renderer/loop_replicator.h"

#include <utility>

namespace curvewall {

void LoopReplicator::draw(const PieceDraw& draw) {
    draw.timer.begin("surfaces");
    bindStorage(2, draw.pieces.pieces);
    for (const SceneChunk& chunk : chunks_) {
        draw.materials.bindVertices(chunk);
        for (int piece = 0; piece < draw.pieces.pieceCount; ++piece) {
            for (const ChunkRange& range : chunk.ranges) {
                const GLuint program = draw.materials.bind(range.material);
                glProgramUniform1ui(program, 18, static_cast<GLuint>(piece));
                draw.materials.programs.setFacing(program,
                                                  draw.pieces.frontIsClockwise[static_cast<size_t>(piece)]);
                range_.clear();
                range_.add(range.firstTriangle, range.triangleCount);
                range_.draw(draw.materials.programs);
                pairCount_ += range.triangleCount;
            }
        }
    }
}

FrameOutcome LoopReplicator::finishFrame() { return {.pairCount = std::exchange(pairCount_, 0)}; }

}  // namespace curvewall
