#include "renderer/pair_replicator.h"

#include "renderer/pair_drawing.h"

namespace curvewall {

PairReplicator::PairReplicator(std::span<const SceneChunk> chunks, uint32_t mostPairs, MeshletLookup lookup)
    : coverage_(chunks, mostPairs, lookup), emptyVertexArray_(makeVertexArray()) {}

void PairReplicator::draw(const PieceDraw& draw) {
    coverage_.beginFrame();
    for (size_t i = 0; i < coverage_.parts().size(); ++i) {
        const ScenePart& part = coverage_.parts()[i];
        if (part.meshletCount == 0) continue;
        coverage_.findPairs(i, draw.pieces, draw.view, sampleGridOf(draw.pieces, draw.pass), &draw.timer);
        draw.timer.begin("surfaces");
        glBindVertexArray(emptyVertexArray_.id());
        bindStorage(2, draw.pieces.pieces);
        drawPairs(*part.chunk, part.ranges, coverage_.pairs(), coverage_.commands(), draw.materials);
    }
}

}  // namespace curvewall
