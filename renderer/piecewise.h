#pragma once
// Piecewise perspective rendering (Lorenz and Doellner, 2009): the scene is drawn once, every triangle into
// just the pieces that it touches, each piece a plain perspective projection.

#include "renderer/coverage.h"
#include "renderer/frame_pass.h"
#include "renderer/scene_programs.h"

#include <memory>
#include <optional>

namespace curvewall {

// How pieces reach the shaders, which are compiled for that.
GeometryPath pathThrough(const GpuPieces& pieces, const GpuOwners* owners, OutputKind output);

// Draws a scene through one piece mesh. A mesh of one piece is one plain draw. The scene and the pieces must
// outlive it.
class PiecewiseRenderer {
public:
    // `coverage` finds the pairs where there are several pieces; it serves all renderers of its scene, one
    // frame at a time. With one piece it may be null. `owners` is needed where the display has holes and for
    // OutputKind::coverage and position, where each pixel must be its owner's; elsewhere it may be null.
    PiecewiseRenderer(const GpuScene& scene, const GpuPieces& pieces, Coverage* coverage, SceneLook look,
                      const GpuOwners* owners);

    // The same with programs that others use too; they must be for pathThrough().
    PiecewiseRenderer(std::shared_ptr<const ScenePrograms> programs, const GpuScene& scene,
                      const GpuPieces& pieces, Coverage* coverage, const GpuOwners* owners);

    // Draws into the bound framebuffer. Records GL work only: nothing is allocated, compiled or read back.
    void record(const SceneView& view, const FramePass& pass = {});

    // Pairs of the frame just finished, or nothing when some found no room: then record it once more.
    // Call it after the GPU has finished.
    std::optional<uint64_t> finishFrame();

private:
    void recordPlain();
    void recordPairs(const SceneView& view);
    void bindChunk(const SceneChunk& chunk) const;        // what corners are pulled from
    GLuint bindMaterial(const Material& material) const;  // the program that is current then

    const GpuScene& scene_;
    const GpuPieces& pieces_;
    Coverage* coverage_;  // null: one plain draw
    const GpuOwners* owners_;
    std::shared_ptr<const ScenePrograms> programs_;
    GlVertexArray emptyVertexArray_;
};

}  // namespace curvewall
