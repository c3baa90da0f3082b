#include "renderer/bounded_raycast.h"

#include "renderer/blended_triangles.h"

#include <numbers>
#include <span>
#include <utility>

namespace curvewall {

GeometryPath boundedPathThrough(const RoundLens& lens, BoundingShape shape, int samples,
                                BoundedPath::Fragments fragments) {
    return {.source = CornerSource::bounded,
            .bounded = {.shape = shape,
                        .lens = lens.function.model,
                        .isWide = lens.edgeRad > std::numbers::pi / 2,
                        .perSample = samples > 1,
                        .fragments = fragments}};
}

BoundedRaycastRenderer::BoundedRaycastRenderer(std::shared_ptr<const ScenePrograms> programs,
                                               const GpuScene& scene, LensRays& rays,
                                               std::vector<glm::dvec2> sampleOffsetsPx)
    : programs_(std::move(programs)),
      scene_(scene),
      rays_(rays),
      sampleOffsetsPx_(std::move(sampleOffsetsPx)),
      runs_([lens = rays.lens()](glm::vec3 centre, float radius) {
          return reachesInto(lens, centre, radius);
      }) {}

void BoundedRaycastRenderer::record(const SceneView& view, const FramePass& pass) {
    timer_.begin("rays");
    const std::span<const glm::dvec2> offsetsPx(sampleOffsetsPx_);
    rays_.fill(offsetsPx.subspan(static_cast<size_t>(pass.firstSample), static_cast<size_t>(pass.samples)));
    glBindTextureUnit(1, rays_.texture().id());
    glBindSampler(1, 0);
    enableClipPlanes(0);
    programs_->setFrame(view, rays_.lens(), pass);
    for (const GlSampler& sampler : scene_.samplers)
        glSamplerParameterf(sampler.id(), GL_TEXTURE_LOD_BIAS, pass.lodBias);
    runs_.beginPass();
    timer_.begin("surfaces");
    draw(scene_.chunks, view);
    // Distances and points are those of what hides the rest.
    const OutputKind output = programs_->look().output;
    if (scene_.blended && (output == OutputKind::color || output == OutputKind::coverage))
        recordBlended(view);
    timer_.end();
}

void BoundedRaycastRenderer::draw(std::span<const SceneChunk> chunks, const SceneView& view) {
    const MaterialBinder materials{scene_, *programs_};
    for (const SceneChunk& chunk : chunks) {
        glBindVertexArray(chunk.vertexArray.id());
        materials.bindPulled(chunk);
        for (const ChunkRange& range : chunk.ranges) {
            const TriangleRuns& runs = runs_.find(chunk, range, view);
            if (runs.isEmpty()) continue;
            materials.bind(range.material);
            runs.draw(*programs_);
        }
    }
}

void BoundedRaycastRenderer::recordBlended(const SceneView& view) {
    scene_.blended->sortFor(view);
    const bool mixes = programs_->look().output == OutputKind::color;
    glDepthMask(GL_FALSE);
    if (mixes) glEnable(GL_BLEND);
    draw({&scene_.blended->chunk(), 1}, view);
    if (mixes) glDisable(GL_BLEND);
    glDepthMask(GL_TRUE);
}

}  // namespace curvewall
