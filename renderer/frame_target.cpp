#include "renderer/frame_target.h"

#include "renderer/image_file.h"

#include <algorithm>
#include <array>

namespace curvewall {

GLenum internalFormatOf(TargetFormat format) {
    switch (format.output) {
        case OutputKind::color:
            return format.linear ? GL_RGBA32F : GL_SRGB8_ALPHA8;
        case OutputKind::position:
            return GL_RGBA32F;
        case OutputKind::depth:
        case OutputKind::coverage:
            return GL_R32F;
    }
    return GL_RGBA32F;
}

FrameTarget::FrameTarget(glm::ivec2 sizePx, TargetFormat format, int samples)
    : sizePx_(sizePx), format_(format), texture_(makeTexture2D(internalFormatOf(format), sizePx)) {
    depth_ = makeRenderbuffer(GL_DEPTH_COMPONENT32F, sizePx, samples);
    framebuffer_ = makeFramebuffer();
    glNamedFramebufferTexture(framebuffer_.id(), GL_COLOR_ATTACHMENT0, texture_.id(), 0);
    if (samples > 1) {
        multisampleColor_ = makeRenderbuffer(internalFormatOf(format), sizePx, samples);
        drawFramebuffer_ = makeFramebuffer();
        glNamedFramebufferRenderbuffer(drawFramebuffer_.id(), GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER,
                                       multisampleColor_.id());
    }
    const GlFramebuffer& drawn = samples > 1 ? drawFramebuffer_ : framebuffer_;
    glNamedFramebufferRenderbuffer(drawn.id(), GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth_.id());
    requireComplete(drawn, sizePx);
}

void FrameTarget::bind() const {
    glBindFramebuffer(GL_FRAMEBUFFER, drawnInto().id());
    glViewport(0, 0, sizePx_.x, sizePx_.y);
}

void FrameTarget::begin(glm::vec3 background) const {
    bind();
    clearTarget(drawnInto().id(), format_.output, background);
    setSceneState(format_.output);
}

void FrameTarget::end() const {
    if (!drawFramebuffer_) return;
    glBlitNamedFramebuffer(drawFramebuffer_.id(), framebuffer_.id(), 0, 0, sizePx_.x, sizePx_.y, 0, 0,
                           sizePx_.x, sizePx_.y, GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

void FrameTarget::copyInto(GLuint framebuffer) const {
    glEnable(GL_FRAMEBUFFER_SRGB);
    glBlitNamedFramebuffer(framebuffer_.id(), framebuffer, 0, 0, sizePx_.x, sizePx_.y, 0, 0, sizePx_.x,
                           sizePx_.y, GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

int FrameTarget::samples() const {
    GLint samples = 0;
    glGetNamedRenderbufferParameteriv(depth_.id(), GL_RENDERBUFFER_SAMPLES, &samples);
    return std::max(samples, 1);
}

size_t FrameTarget::memoryBytes() const {
    return sizeOf(texture_) + sizeOf(depth_) + sizeOf(multisampleColor_);
}

Frame FrameTarget::read() const {
    Frame frame{sizePx_, channelsOf(format_.output), {}};
    const size_t rowTexels = static_cast<size_t>(sizePx_.x) * static_cast<size_t>(frame.channels);
    frame.texels.resize(rowTexels * static_cast<size_t>(sizePx_.y));
    const bool isSrgb = internalFormatOf(format_) == GL_SRGB8_ALPHA8;
    const GLenum layout = frame.channels == 3 ? GL_RGB : GL_RED;
    std::vector<uint8_t> bytes(isSrgb ? rowTexels : 0);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    // Row by row: the size of a large frame in bytes does not fit the 32 bits of OpenGL's argument.
    for (int y = 0; y < sizePx_.y; ++y) {
        float* row = &frame.texels[static_cast<size_t>(y) * rowTexels];
        if (isSrgb) {
            glGetTextureSubImage(texture_.id(), 0, 0, y, 0, sizePx_.x, 1, 1, layout, GL_UNSIGNED_BYTE,
                                 static_cast<GLsizei>(rowTexels), bytes.data());
            std::ranges::transform(bytes, row, linearFromSrgbByte);
        } else {
            glGetTextureSubImage(texture_.id(), 0, 0, y, 0, sizePx_.x, 1, 1, layout, GL_FLOAT,
                                 static_cast<GLsizei>(rowTexels * sizeof(float)), row);
        }
    }
    return frame;
}

void setSceneState(OutputKind output) {
    glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    glEnable(GL_FRAMEBUFFER_SRGB);
    glDisable(GL_CULL_FACE);
    glDepthFunc(GL_GREATER);
    const bool counts = output == OutputKind::coverage;
    (counts ? glDisable : glEnable)(GL_DEPTH_TEST);
    (counts ? glEnable : glDisable)(GL_BLEND);
    glBlendFunc(GL_ONE, GL_ONE);
}

void clearTarget(GLuint framebuffer, OutputKind output, glm::vec3 background) {
    glEnable(GL_FRAMEBUFFER_SRGB);
    glDepthMask(GL_TRUE);
    const float far = 0;
    const std::array<float, 3> empty = emptyTexel(output, background);
    const std::array<float, 4> texel{empty[0], empty[1], empty[2], 1};
    glClearNamedFramebufferfv(framebuffer, GL_COLOR, 0, texel.data());
    glClearNamedFramebufferfv(framebuffer, GL_DEPTH, 0, &far);
}

}  // namespace curvewall
