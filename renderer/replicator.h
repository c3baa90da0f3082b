#pragma once
// Draws triangles into all the pieces that they touch; one implementation an engine.

#include "renderer/engine.h"
#include "renderer/frame_pass.h"
#include "renderer/gl/stage_timer.h"
#include "renderer/gpu_pieces.h"
#include "renderer/gpu_scene.h"
#include "renderer/material_binder.h"
#include "renderer/scene_view.h"

#include <cstdint>
#include <memory>
#include <span>

namespace curvewall {

// One pass over the pieces.
struct PieceDraw {
    const GpuPieces& pieces;
    const SceneView& view;
    const FramePass& pass;
    const MaterialBinder& materials;
    StageTimer& timer;
};

// After the GPU has finished a frame: how many (triangle, piece) pairs it had, in the pass that had the most,
// and whether some found no room. Then there is more room now, and the frame must be drawn again.
struct FrameOutcome {
    uint64_t pairCount = 0;
    uint64_t meshletCount = 0;  // that showed something, where the engine looks at them
    bool overflowed = false;
    const char* refusal = nullptr;  // why the frame must not be shown, whatever room there is

    FrameOutcome& operator+=(const FrameOutcome& other);
};

class Replicator {
public:
    virtual ~Replicator() = default;

    // Records GL work only: nothing is read back, compiled, or allocated but where a scene that changes has
    // outgrown its buffers.
    virtual void draw(const PieceDraw& draw) = 0;

    virtual FrameOutcome finishFrame() = 0;

    // Of its buffers.
    virtual size_t memoryBytes() const { return 0; }
};

// For the chunks of a scene that outlive it.
std::unique_ptr<Replicator> makeReplicator(Engine engine, std::span<const SceneChunk> chunks);

}  // namespace curvewall
