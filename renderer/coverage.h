#pragma once
// Finds the (triangle, piece) pairs of a frame on the GPU, meshlet by meshlet and then triangle by triangle.

#include "renderer/frame_pass.h"
#include "renderer/gl/program.h"
#include "renderer/gpu_pieces.h"
#include "renderer/gpu_scene.h"
#include "renderer/replicator.h"
#include "renderer/scene_view.h"

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace curvewall {

// A run of a chunk's meshlets that is counted, replicated and drawn before the next one.
struct ScenePart {
    const SceneChunk* chunk = nullptr;
    uint32_t firstMeshlet = 0;
    uint32_t meshletCount = 0;
    uint32_t mostMeshlets = 0;       // of a chunk that changes
    std::vector<ChunkRange> ranges;  // firstMeshlet is within the part
    GlBuffer rangeBuffer;            // the same for draw_commands.comp

    ScenePart(const SceneChunk& chunk, uint32_t firstMeshlet, uint32_t mostMeshlets);

    // Takes over what the chunk holds now.
    void update();

    bool isSplittable() const { return meshletCount > 1; }
    std::pair<ScenePart, ScenePart> halves() const;
};

// How the nodes of the piece tree for a meshlet are found: by a walk, or in a grid.
enum class MeshletLookup { tree, grid };

// The compute engine: no read-back within a frame. Buffers grow between frames only.
class Coverage {
public:
    // The chunks must outlive it. `mostPairs` limits the pairs of a part below what the driver allows.
    explicit Coverage(std::span<const SceneChunk> chunks, uint32_t mostPairs = ~0u,
                      MeshletLookup lookup = MeshletLookup::grid);

    // Of parts of triangles for vertex-warp instead of pieces, on displays of this map (see screen_map.h).
    Coverage(std::span<const SceneChunk> chunks, const std::vector<std::string>& screenMap,
             uint32_t mostPairs = ~0u);

    const std::vector<ScenePart>& parts() const { return parts_; }

    // Before the parts of a frame. Buffers grow here where a chunk that changes has outgrown them.
    void beginFrame();

    // Leaves the pairs and one indirect draw command a range in pairs() and commands(). What lies between the
    // points of `sampleGrid` (as sampleGridOf() gives it) is left out; zeros leave nothing out.
    void findPairs(size_t part, const GpuPieces& pieces, const SceneView& view, glm::vec4 sampleGrid,
                   StageTimer* timer = nullptr);
    // The same for parts of triangles, through the map that is bound.
    void findParts(size_t part, const SceneView& view, StageTimer* timer = nullptr);
    const GlBuffer& pairs() const { return pairs_; }
    const GlBuffer& triangleParts() const { return triangleParts_; }  // the corners of each pair's part
    // Of each meshlet of the part: the first of its nodes and the one after the last.
    const GlBuffer& meshletNodes() const { return meshletNodes_; }
    const GlBuffer& commands() const { return commands_; }

    FrameOutcome finishFrame();

    size_t memoryBytes() const;

private:
    struct Shaders {
        std::vector<std::string> forMeshlets, forTriangles;  // what they are compiled with
    };
    // Lets the shaders that look at triangles read what meshlets did not need.
    using BindForTriangles = std::function<void()>;

    Coverage(std::span<const SceneChunk> chunks, const Shaders& shaders, uint32_t mostPairs);
    void allocate();
    void bindForPart(const ScenePart& part);
    void setForPart(size_t part, const SceneView& view);
    void run(const ScenePart& part, const BindForTriangles& bindForTriangles, StageTimer* timer);
    // What the GPU has counted of a part.
    struct Totals {
        uint32_t pairs, meshlets;
        uint32_t refusal;  // vertex-warp: why a triangle cannot be divided, as warp_parts.glsl has it, or 0
    };
    Totals takeTotals(size_t part);

    GlProgram scanMeshlets_, gather_, scanPairs_, commandsProgram_, mark_, count_, emit_;
    std::vector<ScenePart> parts_;
    uint32_t mostPairs_;
    MeshletLookup lookup_ = MeshletLookup::grid;
    bool findsParts_ = false;
    uint32_t capacity_ = 0;  // pairs
    uint32_t meshletCapacity_ = 0;
    size_t rangeCapacity_ = 0;
    GlBuffer groupSeen_, meshletNodes_, seen_, placeOf_, dispatch_;
    GlBuffer groupPairs_, found_, pairs_, triangleParts_, commands_, totalsBuffer_;
    volatile Totals* totals_ = nullptr;  // totalsBuffer_, mapped for as long as it lives
};

}  // namespace curvewall
