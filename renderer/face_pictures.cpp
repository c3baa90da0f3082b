#include "renderer/face_pictures.h"

#include "calibration/errors.h"

#include <algorithm>
#include <string>

namespace curvewall {
namespace {

GlTexture makeLayers(GLenum format, glm::ivec2 sizePx, size_t count, int levels, int samples = 1) {
    const auto layers = static_cast<GLsizei>(std::max<size_t>(count, 1));
    GLuint id = 0;
    glCreateTextures(samples > 1 ? GL_TEXTURE_2D_MULTISAMPLE_ARRAY : GL_TEXTURE_2D_ARRAY, 1, &id);
    GlTexture texture(id);
    if (samples > 1)
        glTextureStorage3DMultisample(id, samples, format, sizePx.x, sizePx.y, layers, GL_TRUE);
    else
        glTextureStorage3D(id, 1 + levels, format, sizePx.x, sizePx.y, layers);
    return texture;
}

GlFramebuffer framebufferOfLayer(const GlTexture& texture, size_t layer) {
    GlFramebuffer framebuffer = makeFramebuffer();
    glNamedFramebufferTextureLayer(framebuffer.id(), GL_COLOR_ATTACHMENT0, texture.id(), 0,
                                   static_cast<GLint>(layer));
    return framebuffer;
}

void requireHardwareSamples(int samples) {
    GLint most = 1;
    glGetIntegerv(GL_MAX_SAMPLES, &most);
    if (samples > most)
        throw UsageError("layered faces have at most " + std::to_string(most) +
                         " samples a texel with this OpenGL; separate ones have any number");
}

}  // namespace

FacePictures::FacePictures(const PicturesLayout& layout, TargetFormat format, int samples)
    : layout_(layout),
      format_(format),
      texture_(
          makeLayers(internalFormatOf(format), layout.layerSizePx, layout.sizesPx.size(), layout.levels)) {
    for (size_t i = 0; i < layout.sizesPx.size(); ++i) layers_.push_back(framebufferOfLayer(texture_, i));
    if (layout.pass == FacePass::layered)
        makeLayered(samples);
    else
        makeSeparate(samples);
}

void FacePictures::makeSeparate(int samples) {
    if (samples > 1)
        samples_.emplace(layout_.layerSizePx, format_, samples);
    else
        depth_ = makeRenderbuffer(GL_DEPTH_COMPONENT32F, layout_.layerSizePx);
    for (const GlFramebuffer& layer : layers_) {
        if (!samples_)
            glNamedFramebufferRenderbuffer(layer.id(), GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth_.id());
        requireComplete(layer, layout_.layerSizePx);
    }
}

void FacePictures::makeLayered(int samples) {
    requireHardwareSamples(samples);
    const size_t count = layers_.size();
    allDepths_ = makeLayers(GL_DEPTH_COMPONENT32F, layout_.layerSizePx, count, 0, samples);
    if (samples > 1) {
        allSamples_ = makeLayers(internalFormatOf(format_), layout_.layerSizePx, count, 0, samples);
        for (size_t i = 0; i < count; ++i) sampledLayers_.push_back(framebufferOfLayer(allSamples_, i));
    }
    all_ = makeFramebuffer();
    glNamedFramebufferTexture(all_.id(), GL_COLOR_ATTACHMENT0, (samples > 1 ? allSamples_ : texture_).id(),
                              0);
    glNamedFramebufferTexture(all_.id(), GL_DEPTH_ATTACHMENT, allDepths_.id(), 0);
    requireComplete(all_, layout_.layerSizePx);
}

void FacePictures::draw(size_t picture, glm::vec3 background,
                        const std::function<void(const FramePass&)>& record) const {
    const GLuint layer = layers_[picture].id();
    const glm::ivec2 sizePx = layout_.sizesPx[picture];
    // Nothing is read of the rest of a layer.
    glScissor(0, 0, sizePx.x, sizePx.y);
    glEnable(GL_SCISSOR_TEST);
    if (samples_) {
        samples_->draw(background, [&](const FramePass& pass) {
            glViewport(0, 0, sizePx.x, sizePx.y);
            record(pass);
        });
        samples_->picture().copyInto(layer);
    } else {
        glBindFramebuffer(GL_FRAMEBUFFER, layer);
        glViewport(0, 0, sizePx.x, sizePx.y);
        clearTarget(layer, format_.output, background);
        setSceneState(format_.output);
        record({});
    }
    glDisable(GL_SCISSOR_TEST);
}

void FacePictures::drawAll(glm::vec3 background, const std::function<void(const FramePass&)>& record) const {
    glBindFramebuffer(GL_FRAMEBUFFER, all_.id());
    clearTarget(all_.id(), format_.output, background);
    for (size_t i = 0; i < layout_.sizesPx.size(); ++i) {
        const glm::vec2 sizePx(layout_.sizesPx[i]);
        glViewportIndexedf(static_cast<GLuint>(i), 0, 0, sizePx.x, sizePx.y);
    }
    setSceneState(format_.output);
    record({});
    for (size_t i = 0; i < sampledLayers_.size(); ++i) {
        const glm::ivec2 sizePx = layout_.sizesPx[i];
        glBlitNamedFramebuffer(sampledLayers_[i].id(), layers_[i].id(), 0, 0, sizePx.x, sizePx.y, 0, 0,
                               sizePx.x, sizePx.y, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    }
}

void FacePictures::makeLevels() const {
    if (layout_.levels > 0) glGenerateTextureMipmap(texture_.id());
}

size_t FacePictures::memoryBytes() const {
    return sizeOf(texture_) + sizeOf(depth_) + (samples_ ? samples_->memoryBytes() : 0) + sizeOf(allDepths_) +
           sizeOf(allSamples_);
}

}  // namespace curvewall
