#include "renderer/face_pictures.h"

#include <algorithm>

namespace curvewall {
namespace {

GlTexture makeLayers(GLenum format, glm::ivec2 sizePx, size_t count) {
    GLuint id = 0;
    glCreateTextures(GL_TEXTURE_2D_ARRAY, 1, &id);
    GlTexture texture(id);
    glTextureStorage3D(id, 1, format, sizePx.x, sizePx.y, static_cast<GLsizei>(count));
    return texture;
}

}  // namespace

FacePictures::FacePictures(glm::ivec2 sizePx, size_t count, TargetFormat format, int samples)
    : sizePx_(sizePx),
      format_(format),
      texture_(makeLayers(internalFormatOf(format), sizePx, std::max<size_t>(count, 1))) {
    if (samples > 1)
        samples_.emplace(sizePx, format, samples);
    else
        depth_ = makeRenderbuffer(GL_DEPTH_COMPONENT32F, sizePx);
    for (size_t i = 0; i < count; ++i) {
        const GlFramebuffer& layer = layers_.emplace_back(makeFramebuffer());
        glNamedFramebufferTextureLayer(layer.id(), GL_COLOR_ATTACHMENT0, texture_.id(), 0,
                                       static_cast<GLint>(i));
        if (!samples_)
            glNamedFramebufferRenderbuffer(layer.id(), GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth_.id());
        requireComplete(layer, sizePx);
    }
}

void FacePictures::draw(size_t picture, glm::vec3 background,
                        const std::function<void(const FramePass&)>& record) const {
    const GLuint layer = layers_[picture].id();
    if (samples_) {
        samples_->draw(background, record);
        samples_->picture().copyInto(layer);
        return;
    }
    glBindFramebuffer(GL_FRAMEBUFFER, layer);
    glViewport(0, 0, sizePx_.x, sizePx_.y);
    clearTarget(layer, format_.output, background);
    setSceneState(format_.output);
    record({});
}

}  // namespace curvewall
