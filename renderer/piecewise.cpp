#include "renderer/piecewise.h"

#include "renderer/blended_triangles.h"
#include "renderer/holes.h"

#include <utility>

namespace curvewall {
namespace {

std::span<const SceneChunk> blendedChunk(const GpuScene& scene) { return {&scene.blended->chunk(), 1}; }

CornerSource cornersFor(Engine engine) {
    switch (engine) {
        case Engine::compute:
        case Engine::geometry:
            return CornerSource::pairs;
        case Engine::tessellation:
            return CornerSource::tessellated;
        case Engine::loop:
            return CornerSource::loop;
    }
    return CornerSource::pairs;
}

}  // namespace

size_t memoryBytesOf(const SceneReplicators& replicators) {
    return replicators.opaque->memoryBytes() + (replicators.blended ? replicators.blended->memoryBytes() : 0);
}

SceneReplicators makeReplicators(Engine engine, const GpuScene& scene) {
    SceneReplicators replicators{engine, makeReplicator(engine, scene.chunks), nullptr};
    if (scene.blended) replicators.blended = makeReplicator(engine, blendedChunk(scene));
    return replicators;
}

GeometryPath pathThrough(const GpuPieces& pieces, const PieceOwners& owners, OutputKind output, Engine engine,
                         int samples) {
    GeometryPath path{.clipPlanes = pieces.clipPlanes};
    const bool hasHoles = owners.ofPixels && owners.ofPixels->hasHoles();
    path.closesHoles = hasHoles && output != OutputKind::coverage;
    if (pieces.pieceCount > 1) {
        path.source = cornersFor(engine);
        path.singleCover = output == OutputKind::coverage || output == OutputKind::position;
        path.ownerSamples = owners.ofSamples ? samples : 1;
    } else {
        // Counted without a depth test, which keeps all else out of holes.
        path.singleCover = output == OutputKind::coverage && hasHoles;
    }
    return path;
}

PiecewiseRenderer::PiecewiseRenderer(const GpuScene& scene, const GpuPieces& pieces,
                                     SceneReplicators* replicators, SceneLook look, const PieceOwners& owners)
    : PiecewiseRenderer(std::make_shared<const ScenePrograms>(
                            *scene.scene, look,
                            pathThrough(pieces, owners, look.output,
                                        replicators ? replicators->engine : Engine::compute, 1)),
                        scene, pieces, replicators, owners) {}

PiecewiseRenderer::PiecewiseRenderer(std::shared_ptr<const ScenePrograms> programs, const GpuScene& scene,
                                     const GpuPieces& pieces, SceneReplicators* replicators,
                                     const PieceOwners& owners)
    : scene_(scene),
      pieces_(pieces),
      replicators_(pieces.pieceCount > 1 ? replicators : nullptr),
      owners_(owners),
      programs_(std::move(programs)),
      emptyVertexArray_(makeVertexArray()) {
    if (!replicators_) plainDraw_.emplace(pieces);
}

void PiecewiseRenderer::record(const SceneView& view, const FramePass& pass) {
    if (programs_->forHoles()) {
        timer_.begin("holes");
        enableClipPlanes(0);
        closeHoles(programs_->forHoles(), *owners_.ofPixels, pieces_.sizePx, emptyVertexArray_);
    }
    programs_->setFrame(view, pieces_.sizePx, pass);
    programs_->setFacing(pieces_.frontIsClockwise.front());
    for (const GlSampler& sampler : scene_.samplers)
        glSamplerParameterf(sampler.id(), GL_TEXTURE_LOD_BIAS, pass.lodBias);
    const MaterialBinder materials{scene_, *programs_};
    const PieceDraw draw{pieces_, view, pass, materials, timer_};
    prepareSurfaces();
    if (plainDraw_) plainDraw_->beginPass();
    if (replicators_)
        replicators_->opaque->draw(draw);
    else
        plainDraw_->draw(scene_.chunks, draw);
    if (strokes_) {
        timer_.begin("strokes");
        strokes_->recordSolid(view, pass);
    }
    // Distances and points are those of what hides the rest.
    if (scene_.blended && (output() == OutputKind::color || output() == OutputKind::coverage))
        recordBlended(draw);
    if (strokes_) {
        timer_.begin("strokes");
        strokes_->recordBlended(view, pass);
    }
    timer_.end();
}

void PiecewiseRenderer::prepareSurfaces() const {
    enableClipPlanes(pieces_.clipPlanes);
    const GpuOwners* owners = owners_.ofSamples ? owners_.ofSamples : owners_.ofPixels;
    if (owners) glBindTextureUnit(1, owners->texture.id());
}

void PiecewiseRenderer::recordBlended(const PieceDraw& draw) {
    prepareSurfaces();
    scene_.blended->sortFor(draw.view);
    const bool mixes = output() == OutputKind::color;
    glDepthMask(GL_FALSE);
    if (mixes) glEnable(GL_BLEND);
    if (replicators_)
        replicators_->blended->draw(draw);
    else
        plainDraw_->draw(blendedChunk(scene_), draw);
    if (mixes) glDisable(GL_BLEND);
    glDepthMask(GL_TRUE);
}

FrameOutcome PiecewiseRenderer::finishFrame() {
    FrameOutcome outcome;
    // Pairs and meshlets are those of surfaces.
    if (strokes_) outcome.overflowed = strokes_->finishFrame().overflowed;
    if (plainDraw_) outcome += plainDraw_->finishFrame();
    if (replicators_) outcome += replicators_->opaque->finishFrame();
    if (replicators_ && replicators_->blended) outcome += replicators_->blended->finishFrame();
    return outcome;
}

}  // namespace curvewall
