#pragma once
// Each vertex goes where the display shows it, and triangles between are drawn straight: the curvilinear
// vertex shader (Oros, A conceptual and practical look into spherical curvilinear projection) and camera
// textures as first drawn (Lorenz and Doellner, 2009, section 1.1), per vertex or finely tessellated.

#include "renderer/coverage.h"
#include "renderer/scene_programs.h"
#include "renderer/screen_map.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace curvewall {

// A display as the shaders see it, for edges of one length.
struct GpuWarp {
    std::shared_ptr<const GpuScreenMap> map;
    GlBuffer numbers;
    glm::ivec2 sizePx{0};
    bool tessellates = false;
    std::shared_ptr<const GpuOwners> owners;  // whether a pixel shows anything
};

// `tessellationPx` of 0 leaves triangles as they are, but for those seen under more than 45 degrees.
GpuWarp makeWarp(std::shared_ptr<const GpuScreenMap> map, std::shared_ptr<const GpuOwners> owners,
                 glm::ivec2 sizePx, double tessellationPx);

// How the corners reach the shaders, which are compiled for that.
GeometryPath pathThrough(const GpuWarp& warp, OutputKind output);

// What finds the parts of a scene's triangles, one frame at a time for all renderers of the scene.
struct SceneParts {
    SceneParts(const GpuScene& scene, const std::vector<std::string>& screenMap);

    size_t memoryBytes() const;

    Coverage opaque;
    std::optional<Coverage> blended;  // where the scene has such triangles
};

// The scene, the warp and the parts must outlive it.
class VertexWarpRenderer {
public:
    // The programs must be those of pathThrough().
    VertexWarpRenderer(std::shared_ptr<const ScenePrograms> programs, const GpuScene& scene,
                       const GpuWarp& warp, SceneParts& parts);

    // Draws into the bound framebuffer. Records GL work only: nothing is compiled or read back.
    void record(const SceneView& view, const FramePass& pass = {});

    // What the frame just finished took; pairs are (triangle, part) pairs. Call it after the GPU has
    // finished; where it overflowed, record the frame once more.
    FrameOutcome finishFrame();

    const ScenePrograms& programs() const { return *programs_; }

    // Of the frames since it was asked last, where stages are timed.
    void timeStages(bool on) { timer_.turn(on); }
    std::vector<StageTime> takeStageTimes() { return timer_.take(); }

private:
    void recordSurfaces(Coverage& parts, const SceneView& view);
    void recordBlended(const SceneView& view);

    std::shared_ptr<const ScenePrograms> programs_;
    const GpuScene& scene_;
    const GpuWarp& warp_;
    SceneParts& parts_;
    GlVertexArray emptyVertexArray_;
    StageTimer timer_;
};

}  // namespace curvewall
