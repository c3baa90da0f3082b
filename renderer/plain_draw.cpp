#include "renderer/plain_draw.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>

namespace curvewall {
namespace {

VisibleRuns::SphereTest inPicture(const GpuPieces& pieces) {
    // Clip space is |x| <= w and |y| <= w, and each of these is a plane through the eye.
    const auto& [x, y, w] = pieces.firstRows;
    std::array<glm::vec3, 4> sides{w + x, w - x, w + y, w - y};
    for (glm::vec3& side : sides) side = glm::normalize(side);
    return [sides](glm::vec3 centre, float radius) {
        return std::ranges::all_of(sides, [&](glm::vec3 side) { return glm::dot(side, centre) >= -radius; });
    };
}

}  // namespace

PlainDraw::PlainDraw(const GpuPieces& pieces) : runs_(inPicture(pieces)) {}

void PlainDraw::draw(std::span<const SceneChunk> chunks, const PieceDraw& draw) {
    draw.timer.begin("surfaces");
    bindStorage(2, draw.pieces.pieces);
    for (const SceneChunk& chunk : chunks) {
        draw.materials.bindVertices(chunk);
        for (const ChunkRange& range : chunk.ranges) {
            const TriangleRuns& runs = runs_.find(chunk, range, draw.view);
            if (runs.isEmpty()) continue;
            draw.materials.bind(range.material);
            runs.draw(draw.materials.programs);
        }
    }
}

}  // namespace curvewall
