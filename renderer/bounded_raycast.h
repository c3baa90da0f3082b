#pragma once
// Bounded ray casting (Gascuel, Holzschuch, Fournier and Peroche, 2008) through a round lens: what the lens
// shows of each triangle is bounded by a flat shape, and each pixel of that casts its exact ray at the
// triangle.

#include "renderer/frame_pass.h"
#include "renderer/lens_rays.h"
#include "renderer/replicator.h"
#include "renderer/scene_programs.h"
#include "renderer/visible_runs.h"

#include <memory>
#include <vector>

namespace curvewall {

// How triangles reach the shaders, which are compiled for that. `samples` is how many a pixel has in one
// pass.
GeometryPath boundedPathThrough(const RoundLens& lens, BoundingShape shape, int samples,
                                BoundedPath::Fragments fragments = BoundedPath::Fragments::shown);

// The scene and the rays must outlive it.
class BoundedRaycastRenderer {
public:
    // `programs` are for boundedPathThrough(); `rays` has room for the samples of one pass, and
    // `sampleOffsetsPx` are those of all passes, in order.
    BoundedRaycastRenderer(std::shared_ptr<const ScenePrograms> programs, const GpuScene& scene,
                           LensRays& rays, std::vector<glm::dvec2> sampleOffsetsPx);

    // Draws into the bound framebuffer. Records GL work only. `view` is in lens axes.
    void record(const SceneView& view, const FramePass& pass);

    // Triangles and meshlets of the last pass.
    const FrameOutcome& outcome() const { return runs_.found(); }

    const ScenePrograms& programs() const { return *programs_; }

    // Of the frames since it was asked last, where stages are timed.
    void timeStages(bool on) { timer_.turn(on); }
    std::vector<StageTime> takeStageTimes() { return timer_.take(); }

private:
    void draw(std::span<const SceneChunk> chunks, const SceneView& view);
    void recordBlended(const SceneView& view);

    std::shared_ptr<const ScenePrograms> programs_;
    const GpuScene& scene_;
    LensRays& rays_;
    std::vector<glm::dvec2> sampleOffsetsPx_;
    VisibleRuns runs_;
    StageTimer timer_;
};

}  // namespace curvewall
