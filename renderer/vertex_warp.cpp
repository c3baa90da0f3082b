#include "renderer/vertex_warp.h"

#include "calibration/errors.h"
#include "renderer/blended_triangles.h"
#include "renderer/holes.h"
#include "renderer/pair_drawing.h"

#include <span>
#include <utility>

namespace curvewall {
namespace {

constexpr GLuint kTableUnit = 2;

std::span<const SceneChunk> blendedChunk(const GpuScene& scene) { return {&scene.blended->chunk(), 1}; }

}  // namespace

GpuWarp makeWarp(std::shared_ptr<const GpuScreenMap> map, std::shared_ptr<const GpuOwners> owners,
                 glm::ivec2 sizePx, double tessellationPx) {
    ScreenMapNumbers numbers = map->numbers;
    numbers.finish.y = static_cast<float>(tessellationPx);
    numbers.finish.z = kNearFraction;
    return {std::move(map), makeBuffer(&numbers, sizeof numbers), sizePx, tessellationPx > 0,
            std::move(owners)};
}

GeometryPath pathThrough(const GpuWarp& warp, OutputKind output) {
    const bool counts = output == OutputKind::coverage;
    return {.source = warp.tessellates ? CornerSource::warpedTessellated : CornerSource::warped,
            // Counted without a depth test, which keeps all else out of holes.
            .singleCover = counts && warp.owners->hasHoles(),
            .closesHoles = !counts && warp.owners->hasHoles(),
            .screenMap = warp.map->defines};
}

SceneParts::SceneParts(const GpuScene& scene, const std::vector<std::string>& screenMap)
    : opaque(scene.chunks, screenMap) {
    if (scene.blended) blended.emplace(blendedChunk(scene), screenMap);
}

size_t SceneParts::memoryBytes() const {
    return opaque.memoryBytes() + (blended ? blended->memoryBytes() : 0);
}

VertexWarpRenderer::VertexWarpRenderer(std::shared_ptr<const ScenePrograms> programs, const GpuScene& scene,
                                       const GpuWarp& warp, SceneParts& parts)
    : programs_(std::move(programs)),
      scene_(scene),
      warp_(warp),
      parts_(parts),
      emptyVertexArray_(makeVertexArray()) {}

void VertexWarpRenderer::record(const SceneView& view, const FramePass& pass) {
    for (GLenum plane = 0; plane < 8; ++plane) glDisable(GL_CLIP_DISTANCE0 + plane);
    if (programs_->forHoles()) {
        timer_.begin("holes");
        closeHoles(programs_->forHoles(), *warp_.owners, warp_.sizePx, emptyVertexArray_);
    }
    programs_->setFrame(view, warp_.sizePx, pass);
    for (const GlSampler& sampler : scene_.samplers)
        glSamplerParameterf(sampler.id(), GL_TEXTURE_LOD_BIAS, pass.lodBias);
    glBindBufferBase(GL_UNIFORM_BUFFER, 0, warp_.numbers.id());
    glBindTextureUnit(1, warp_.owners->texture.id());
    glBindTextureUnit(kTableUnit, warp_.map->table.id());
    glBindSampler(kTableUnit, 0);
    glPatchParameteri(GL_PATCH_VERTICES, 3);
    recordSurfaces(parts_.opaque, view);
    // Distances and points are those of what hides the rest.
    const OutputKind output = programs_->look().output;
    if (parts_.blended && (output == OutputKind::color || output == OutputKind::coverage))
        recordBlended(view);
    timer_.end();
}

void VertexWarpRenderer::recordSurfaces(Coverage& parts, const SceneView& view) {
    const MaterialBinder materials{scene_, *programs_};
    parts.beginFrame();
    for (size_t i = 0; i < parts.parts().size(); ++i) {
        const ScenePart& part = parts.parts()[i];
        if (part.meshletCount == 0) continue;
        parts.findParts(i, view, &timer_);
        timer_.begin("surfaces");
        glBindVertexArray(emptyVertexArray_.id());
        bindStorage(8, parts.triangleParts());
        drawPairs(*part.chunk, part.ranges, parts.pairs(), parts.commands(), materials,
                  warp_.tessellates ? GL_PATCHES : GL_TRIANGLES);
    }
}

void VertexWarpRenderer::recordBlended(const SceneView& view) {
    scene_.blended->sortFor(view);
    const bool mixes = programs_->look().output == OutputKind::color;
    glDepthMask(GL_FALSE);
    if (mixes) glEnable(GL_BLEND);
    recordSurfaces(*parts_.blended, view);
    if (mixes) glDisable(GL_BLEND);
    glDepthMask(GL_TRUE);
}

FrameOutcome VertexWarpRenderer::finishFrame() {
    FrameOutcome outcome = parts_.opaque.finishFrame();
    if (parts_.blended) outcome += parts_.blended->finishFrame();
    if (outcome.refusal) {
        timer_.take();  // nothing of this frame counts
        throw UsageError(outcome.refusal);
    }
    return outcome;
}

}  // namespace curvewall
