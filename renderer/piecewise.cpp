#include "renderer/piecewise.h"

#include <utility>

namespace curvewall {

GeometryPath pathThrough(const GpuPieces& pieces, const GpuOwners* owners, OutputKind output) {
    GeometryPath path{.pairs = pieces.pieceCount > 1, .clipPlanes = pieces.clipPlanes};
    const bool singleCover = output == OutputKind::coverage || output == OutputKind::position;
    if (path.pairs && singleCover)
        path.right = PixelRight::owner;
    else if (owners && owners->hasHoles)
        path.right = PixelRight::notHoles;
    return path;
}

PiecewiseRenderer::PiecewiseRenderer(const GpuScene& scene, const GpuPieces& pieces, Coverage* coverage,
                                     SceneLook look, const GpuOwners* owners)
    : PiecewiseRenderer(
          std::make_shared<const ScenePrograms>(*scene.scene, look, pathThrough(pieces, owners, look.output)),
          scene, pieces, coverage, owners) {}

PiecewiseRenderer::PiecewiseRenderer(std::shared_ptr<const ScenePrograms> programs, const GpuScene& scene,
                                     const GpuPieces& pieces, Coverage* coverage, const GpuOwners* owners)
    : scene_(scene),
      pieces_(pieces),
      coverage_(pieces.pieceCount > 1 ? coverage : nullptr),
      owners_(owners),
      programs_(std::move(programs)),
      emptyVertexArray_(makeVertexArray()) {}

void PiecewiseRenderer::record(const SceneView& view, const FramePass& pass) {
    programs_->setFrame(view, pieces_, pass);
    for (const GlSampler& sampler : scene_.samplers)
        glSamplerParameterf(sampler.id(), GL_TEXTURE_LOD_BIAS, pass.lodBias);
    for (int i = 0; i < 8; ++i)
        (i < pieces_.clipPlanes ? glEnable : glDisable)(GL_CLIP_DISTANCE0 + static_cast<GLenum>(i));
    if (owners_) glBindTextureUnit(1, owners_->texture.id());
    if (coverage_)
        recordPairs(view);
    else
        recordPlain();
}

GLuint PiecewiseRenderer::bindMaterial(const Material& material) const {
    const ScenePrograms::Chosen chosen = programs_->choose(material);
    if (chosen.textured) {
        const auto texture = static_cast<size_t>(material.texture);
        glBindTextureUnit(0, scene_.textures[texture].id());
        glBindSampler(0, scene_.samplers[texture].id());
    }
    return chosen.program;
}

void PiecewiseRenderer::bindChunk(const SceneChunk& chunk) const {
    bindStorage(0, chunk.positions);
    bindStorage(1, chunk.corners);
    bindStorage(3, chunk.normals);
    bindStorage(4, chunk.uvs);
    if (programs_->drawsEdges()) bindStorage(7, chunk.across);
}

void PiecewiseRenderer::recordPlain() {
    bindStorage(2, pieces_.pieces);
    const bool pulls = programs_->drawsEdges();
    for (const SceneChunk& chunk : scene_.chunks) {
        if (pulls) bindChunk(chunk);
        glBindVertexArray(pulls ? emptyVertexArray_.id() : chunk.vertexArray.id());
        for (const MaterialRange& range : chunk.ranges) {
            bindMaterial(scene_.scene->materials[range.material]);
            if (pulls)
                glDrawArrays(GL_TRIANGLES, static_cast<GLint>(3 * range.firstTriangle),
                             static_cast<GLsizei>(3 * range.triangleCount));
            else
                glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(3 * range.triangleCount), GL_UNSIGNED_INT,
                               reinterpret_cast<const void*>(size_t{12} * range.firstTriangle));
        }
    }
}

void PiecewiseRenderer::recordPairs(const SceneView& view) {
    for (size_t i = 0; i < coverage_->parts().size(); ++i) {
        const ScenePart& part = coverage_->parts()[i];
        coverage_->findPairs(i, pieces_, view);
        glBindVertexArray(emptyVertexArray_.id());
        glBindBuffer(GL_DRAW_INDIRECT_BUFFER, coverage_->commands().id());
        bindChunk(*part.chunk);
        bindStorage(2, pieces_.pieces);
        bindStorage(5, coverage_->commands());
        bindStorage(6, coverage_->pairs());
        for (size_t r = 0; r < part.ranges.size(); ++r) {
            const GLuint program = bindMaterial(scene_.scene->materials[part.ranges[r].material]);
            glProgramUniform1ui(program, 13, static_cast<GLuint>(r));
            glDrawArraysIndirect(GL_TRIANGLES, reinterpret_cast<const void*>(kDrawCommandBytes * r));
        }
    }
}

std::optional<uint64_t> PiecewiseRenderer::finishFrame() {
    if (!coverage_) return scene_.scene->triangles.size();
    const Coverage::Outcome outcome = coverage_->finishFrame();
    if (outcome.overflowed) return std::nullopt;
    return outcome.pairCount;
}

}  // namespace curvewall
