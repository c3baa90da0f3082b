#pragma once
// Piecewise perspective rendering (Lorenz and Doellner, 2009): the scene is drawn once, every triangle into
// just the pieces that it touches, each piece a plain perspective projection.

#include "renderer/frame_pass.h"
#include "renderer/plain_draw.h"
#include "renderer/replicator.h"
#include "renderer/scene_programs.h"
#include "renderer/stroke_renderer.h"

#include <memory>
#include <optional>
#include <utility>

namespace curvewall {

// How the triangles of a scene get into the pieces, one frame at a time for all renderers of the scene.
struct SceneReplicators {
    Engine engine = Engine::compute;
    std::unique_ptr<Replicator> opaque, blended;  // the second where the scene has such triangles
};

size_t memoryBytesOf(const SceneReplicators& replicators);

SceneReplicators makeReplicators(Engine engine, const GpuScene& scene);

// Whose a pixel is. Each may be null where nothing asks for it.
struct PieceOwners {
    // Needed where the display has holes and for OutputKind::coverage and position.
    const GpuOwners* ofPixels = nullptr;
    // Needed where blended triangles are drawn into several pieces with other samples than the pixel's
    // centre: one layer for each sample of each pass, in order.
    const GpuOwners* ofSamples = nullptr;
};

// How pieces reach the shaders, which are compiled for that. `samples` is how many a pixel has in one pass.
GeometryPath pathThrough(const GpuPieces& pieces, const PieceOwners& owners, OutputKind output, Engine engine,
                         int samples);

// Draws a scene through one piece mesh. A mesh of one piece is one plain draw. The scene, the pieces, their
// owners and the replicators must outlive it.
class PiecewiseRenderer {
public:
    // `replicators` is needed where there are several pieces.
    PiecewiseRenderer(const GpuScene& scene, const GpuPieces& pieces, SceneReplicators* replicators,
                      SceneLook look, const PieceOwners& owners = {});

    // The same with programs that others use too; they must be for pathThrough().
    PiecewiseRenderer(std::shared_ptr<const ScenePrograms> programs, const GpuScene& scene,
                      const GpuPieces& pieces, SceneReplicators* replicators, const PieceOwners& owners);

    // Points and lines of the scene are drawn too.
    void addStrokes(std::unique_ptr<StrokeRenderer> strokes) { strokes_ = std::move(strokes); }

    // Draws into the bound framebuffer. Records GL work only: nothing is compiled or read back.
    void record(const SceneView& view, const FramePass& pass = {});

    // What the frame just finished took. Call it after the GPU has finished; where it overflowed, record the
    // frame once more.
    FrameOutcome finishFrame();

    const ScenePrograms& programs() const { return *programs_; }

    // Of the frames since it was asked last, where stages are timed.
    void timeStages(bool on) { timer_.turn(on); }
    std::vector<StageTime> takeStageTimes() { return timer_.take(); }

private:
    void prepareSurfaces() const;
    void recordBlended(const PieceDraw& draw);
    OutputKind output() const { return programs_->look().output; }

    const GpuScene& scene_;
    const GpuPieces& pieces_;
    SceneReplicators* replicators_;  // null: one plain draw
    std::optional<PlainDraw> plainDraw_;
    PieceOwners owners_;
    std::shared_ptr<const ScenePrograms> programs_;
    std::unique_ptr<StrokeRenderer> strokes_;
    GlVertexArray emptyVertexArray_;
    StageTimer timer_;
};

}  // namespace curvewall
