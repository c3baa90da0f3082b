#pragma once
// Finds the (triangle, piece) pairs of a frame on the GPU.

#include "renderer/gl/program.h"
#include "renderer/gpu_pieces.h"
#include "renderer/gpu_scene.h"
#include "renderer/scene_view.h"

#include <cstdint>
#include <vector>

namespace curvewall {

// Pairs are drawn in instances of so many; see draw_commands.comp.
inline constexpr uint32_t kPairsPerInstance = 64;
inline constexpr size_t kDrawCommandBytes = 5 * sizeof(uint32_t);

// A run of a chunk's triangles that is counted, replicated and drawn before the next one.
struct ScenePart {
    const SceneChunk* chunk = nullptr;
    uint32_t firstTriangle = 0;
    uint32_t triangleCount = 0;
    std::vector<MaterialRange> ranges;  // firstTriangle is within the part
    GlBuffer rangeBuffer;               // the same for draw_commands.comp

    ScenePart(const SceneChunk& chunk, uint32_t firstTriangle, uint32_t triangleCount);
};

// The compute engine: count, scan, emit and draw commands a part, no read-back within a frame. Buffers grow
// between frames only.
class Coverage {
public:
    // `mostPairs` limits the pairs of a part below what the driver allows.
    explicit Coverage(const GpuScene& scene, uint32_t mostPairs = ~0u);

    const std::vector<ScenePart>& parts() const { return parts_; }

    // Leaves the pairs and one indirect draw command a range in pairs() and commands().
    void findPairs(size_t part, const GpuPieces& pieces, const SceneView& view);
    const GlBuffer& pairs() const { return pairs_; }
    const GlBuffer& commands() const { return commands_; }

    // After the GPU has finished a frame: how many pairs it had, and whether some found no room. Then the
    // buffers are larger or the parts smaller, and the frame must be drawn again.
    struct Outcome {
        uint64_t pairCount = 0;
        bool overflowed = false;
    };
    Outcome finishFrame();

private:
    void allocate();
    uint32_t totalOf(size_t part) const { return totals_[part]; }

    GlProgram count_, scan_, emit_, commandsProgram_;
    std::vector<ScenePart> parts_;
    uint32_t mostPairs_;
    uint32_t capacity_ = 0;  // pairs
    GlBuffer groupPairs_, firstPair_, found_, pairs_, commands_, totalsBuffer_;
    const volatile uint32_t* totals_ = nullptr;  // totalsBuffer_, mapped for as long as it lives
};

}  // namespace curvewall
