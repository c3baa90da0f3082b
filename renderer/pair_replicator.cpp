#include "renderer/pair_replicator.h"

namespace curvewall {

PairReplicator::PairReplicator(std::span<const SceneChunk> chunks, uint32_t mostPairs, MeshletLookup lookup)
    : coverage_(chunks, mostPairs, lookup), emptyVertexArray_(makeVertexArray()) {}

void PairReplicator::draw(const PieceDraw& draw) {
    coverage_.beginFrame();
    for (size_t i = 0; i < coverage_.parts().size(); ++i) {
        coverage_.findPairs(i, draw.pieces, draw.view, sampleGridOf(draw.pieces, draw.pass), &draw.timer);
        draw.timer.begin("surfaces");
        drawPairs(coverage_.parts()[i], draw);
    }
}

void PairReplicator::drawPairs(const ScenePart& part, const PieceDraw& draw) const {
    glBindVertexArray(emptyVertexArray_.id());
    glBindBuffer(GL_DRAW_INDIRECT_BUFFER, coverage_.commands().id());
    draw.materials.bindPulled(*part.chunk);
    bindStorage(2, draw.pieces.pieces);
    bindStorage(5, coverage_.commands());
    bindStorage(6, coverage_.pairs());
    for (size_t r = 0; r < part.ranges.size(); ++r) {
        const GLuint program = draw.materials.bind(part.ranges[r].material);
        glProgramUniform1ui(program, 13, static_cast<GLuint>(r));
        glDrawArraysIndirect(GL_TRIANGLES, reinterpret_cast<const void*>(kDrawCommandBytes * r));
    }
}

}  // namespace curvewall
