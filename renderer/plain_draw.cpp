#include "renderer/plain_draw.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <vector>

namespace curvewall {
namespace {

// Planes through the eye, length one, and the sides of a picture.
using Sides = std::array<glm::vec3, 4>;

VisibleRuns::SphereTest inSomePicture(const GpuPieces& pieces) {
    std::vector<Sides> pictures;
    for (const auto& [x, y, w] : pieces.rows) {
        // Clip space is |x| <= w and |y| <= w, and each of these is a plane through the eye.
        Sides& sides = pictures.emplace_back(Sides{w + x, w - x, w + y, w - y});
        for (glm::vec3& side : sides) side = glm::normalize(side);
    }
    return [pictures](glm::vec3 centre, float radius) {
        return std::ranges::any_of(pictures, [&](const Sides& sides) {
            return std::ranges::all_of(sides,
                                       [&](glm::vec3 side) { return glm::dot(side, centre) >= -radius; });
        });
    };
}

}  // namespace

PlainDraw::PlainDraw(const GpuPieces& pieces)
    : isLayered_(pieces.rows.size() > 1), runs_(inSomePicture(pieces)) {}

void PlainDraw::draw(std::span<const SceneChunk> chunks, const PieceDraw& draw) {
    draw.timer.begin("surfaces");
    bindStorage(2, draw.pieces.pieces);
    if (isLayered_) emitted_.begin();
    for (const SceneChunk& chunk : chunks) {
        draw.materials.bindVertices(chunk);
        for (const ChunkRange& range : chunk.ranges) {
            const TriangleRuns& runs = runs_.find(chunk, range, draw.view);
            if (runs.isEmpty()) continue;
            draw.materials.bind(range.material);
            runs.draw(draw.materials.programs);
        }
    }
    if (isLayered_) emitted_.end();
}

FrameOutcome PlainDraw::finishFrame() {
    FrameOutcome drawn = runs_.found();
    if (isLayered_) {
        drawn.pairCount = 0;
        for (const uint64_t count : emitted_.take()) drawn.pairCount += count;
    }
    return drawn;
}

}  // namespace curvewall
