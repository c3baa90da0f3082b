#include "renderer/image_based.h"

#include "renderer/cube_faces.h"

namespace curvewall {
namespace {

GlTexture makeCubeMap(GLenum format, int sizePx) {
    GLuint id = 0;
    glCreateTextures(GL_TEXTURE_CUBE_MAP, 1, &id);
    GlTexture texture(id);
    glTextureStorage2D(id, 1, format, sizePx, sizePx);
    return texture;
}

// Light may be blended between texels; distances, counts and points may not.
GlSampler makeFaceSampler(OutputKind output) {
    GLuint id = 0;
    glCreateSamplers(1, &id);
    GlSampler sampler(id);
    const GLint filter = output == OutputKind::color ? GL_LINEAR : GL_NEAREST;
    glSamplerParameteri(id, GL_TEXTURE_MIN_FILTER, filter);
    glSamplerParameteri(id, GL_TEXTURE_MAG_FILTER, filter);
    return sampler;
}

}  // namespace

ImageBasedRenderer::ImageBasedRenderer(const GpuScene& scene, const std::vector<glm::vec4>& rays,
                                       glm::ivec2 sizePx, int faceSizePx, std::array<bool, 6> faces,
                                       double distanceM, SceneLook look, TargetFormat format)
    : scene_(scene),
      faceSizePx_(faceSizePx),
      output_(look.output),
      rays_(makeTexture2D(GL_RGBA32F, sizePx)),
      cube_(makeCubeMap(internalFormatOf(format), faceSizePx)),
      sampler_(makeFaceSampler(look.output)),
      depth_(makeRenderbuffer(GL_DEPTH_COMPONENT32F, glm::ivec2(faceSizePx))),
      resample_(
          makeProgram({{GL_VERTEX_SHADER, "whole_screen.vert"}, {GL_FRAGMENT_SHADER, "resample.frag"}})),
      emptyVertexArray_(makeVertexArray()) {
    glTextureSubImage2D(rays_.id(), 0, 0, 0, sizePx.x, sizePx.y, GL_RGBA, GL_FLOAT, rays.data());
    faces_.reserve(faces.size());  // renderers refer to their face's pieces
    for (int i = 0; i < 6; ++i) {
        if (!faces[static_cast<size_t>(i)]) continue;
        Face& face = faces_.emplace_back();
        face.pieces = uploadPieces(cubeFaceMesh(i, faceSizePx, distanceM));
        face.renderer = std::make_unique<PiecewiseRenderer>(scene, face.pieces, nullptr, look);
        face.framebuffer = makeFramebuffer();
        glNamedFramebufferTextureLayer(face.framebuffer.id(), GL_COLOR_ATTACHMENT0, cube_.id(), 0, i);
        glNamedFramebufferRenderbuffer(face.framebuffer.id(), GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER,
                                       depth_.id());
        requireComplete(face.framebuffer, glm::ivec2(faceSizePx));
    }
}

void ImageBasedRenderer::record(const SceneView& view, const FrameTarget& target, glm::vec3 background) {
    glViewport(0, 0, faceSizePx_, faceSizePx_);
    for (const Face& face : faces_) {
        glBindFramebuffer(GL_FRAMEBUFFER, face.framebuffer.id());
        clearTarget(face.framebuffer.id(), output_, background);
        setSceneState(output_);
        face.renderer->record(view);
    }

    target.begin(background);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_BLEND);
    glEnable(GL_TEXTURE_CUBE_MAP_SEAMLESS);
    glUseProgram(resample_.id());
    glBindTextureUnit(0, cube_.id());
    glBindSampler(0, sampler_.id());
    glBindTextureUnit(1, rays_.id());
    glBindVertexArray(emptyVertexArray_.id());
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

uint64_t ImageBasedRenderer::pairCount() const { return scene_.scene->triangles.size() * faces_.size(); }

}  // namespace curvewall
