#include "renderer/gl/gl_objects.h"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>

namespace curvewall {
namespace {

// Whose bits a texel or pixel is made of.
constexpr std::array<GLenum, 5> kTextureChannels{GL_TEXTURE_RED_SIZE, GL_TEXTURE_GREEN_SIZE,
                                                 GL_TEXTURE_BLUE_SIZE, GL_TEXTURE_ALPHA_SIZE,
                                                 GL_TEXTURE_DEPTH_SIZE};
constexpr std::array<GLenum, 5> kBufferChannels{GL_RENDERBUFFER_RED_SIZE, GL_RENDERBUFFER_GREEN_SIZE,
                                                GL_RENDERBUFFER_BLUE_SIZE, GL_RENDERBUFFER_ALPHA_SIZE,
                                                GL_RENDERBUFFER_DEPTH_SIZE};

}  // namespace

GlBuffer makeBuffer(const void* bytes, size_t size, GLbitfield flags) {
    GLuint id = 0;
    glCreateBuffers(1, &id);
    GlBuffer buffer(id);
    while (glGetError() != GL_NO_ERROR) {
    }
    glNamedBufferStorage(id, static_cast<GLsizeiptr>(std::max<size_t>(size, 4)), size == 0 ? nullptr : bytes,
                         flags);
    if (glGetError() == GL_OUT_OF_MEMORY)
        throw std::runtime_error("OpenGL has no memory for a buffer of " + std::to_string(size) + " bytes");
    return buffer;
}

GlTexture makeTexture2D(GLenum internalFormat, glm::ivec2 sizePx, int levels) {
    GLuint id = 0;
    glCreateTextures(GL_TEXTURE_2D, 1, &id);
    GlTexture texture(id);
    glTextureStorage2D(id, levels, internalFormat, sizePx.x, sizePx.y);
    // Where a sampler object does not say otherwise. Integer textures are incomplete under the default, which
    // is linear.
    glTextureParameteri(id, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTextureParameteri(id, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    return texture;
}

GlRenderbuffer makeRenderbuffer(GLenum internalFormat, glm::ivec2 sizePx, int samples) {
    GLuint id = 0;
    glCreateRenderbuffers(1, &id);
    GlRenderbuffer buffer(id);
    glNamedRenderbufferStorageMultisample(id, samples > 1 ? samples : 0, internalFormat, sizePx.x, sizePx.y);
    return buffer;
}

GlVertexArray makeVertexArray() {
    GLuint id = 0;
    glCreateVertexArrays(1, &id);
    return GlVertexArray(id);
}

GlFramebuffer makeFramebuffer() {
    GLuint id = 0;
    glCreateFramebuffers(1, &id);
    return GlFramebuffer(id);
}

void enableClipPlanes(int count) {
    for (int i = 0; i < 8; ++i)
        (i < count ? glEnable : glDisable)(GL_CLIP_DISTANCE0 + static_cast<GLenum>(i));
}

void bindStorage(GLuint binding, const GlBuffer& buffer) {
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, buffer.id());
}

size_t sizeOf(const GlBuffer& buffer) {
    GLint64 bytes = 0;
    if (buffer) glGetNamedBufferParameteri64v(buffer.id(), GL_BUFFER_SIZE, &bytes);
    return static_cast<size_t>(bytes);
}

size_t sizeOf(const GlTexture& texture) {
    size_t bits = 0;
    GLint levels = 0;
    if (texture) glGetTextureParameteriv(texture.id(), GL_TEXTURE_IMMUTABLE_LEVELS, &levels);
    for (GLint level = 0; level < levels; ++level) {
        const auto number = [&](GLenum name) {
            GLint value = 0;
            glGetTextureLevelParameteriv(texture.id(), level, name, &value);
            return static_cast<size_t>(value);
        };
        size_t bitsATexel = 0;
        for (const GLenum channel : kTextureChannels) bitsATexel += number(channel);
        bits += bitsATexel * number(GL_TEXTURE_WIDTH) * number(GL_TEXTURE_HEIGHT) * number(GL_TEXTURE_DEPTH) *
                std::max<size_t>(number(GL_TEXTURE_SAMPLES), 1);
    }
    return bits / 8;
}

size_t sizeOf(const GlRenderbuffer& buffer) {
    if (!buffer) return 0;
    const auto number = [&](GLenum name) {
        GLint value = 0;
        glGetNamedRenderbufferParameteriv(buffer.id(), name, &value);
        return static_cast<size_t>(value);
    };
    size_t bitsAPixel = 0;
    for (const GLenum channel : kBufferChannels) bitsAPixel += number(channel);
    return bitsAPixel * number(GL_RENDERBUFFER_WIDTH) * number(GL_RENDERBUFFER_HEIGHT) *
           std::max<size_t>(number(GL_RENDERBUFFER_SAMPLES), 1) / 8;
}

void requireComplete(const GlFramebuffer& framebuffer, glm::ivec2 sizePx) {
    if (glCheckNamedFramebufferStatus(framebuffer.id(), GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
        throw std::runtime_error("OpenGL cannot render to a picture of " + std::to_string(sizePx.x) + " x " +
                                 std::to_string(sizePx.y) + " px; it may be too large for its memory");
}

}  // namespace curvewall
