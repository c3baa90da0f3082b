#include "renderer/gl/gl_objects.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace curvewall {

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

size_t sizeOf(const GlBuffer& buffer) {
    GLint64 bytes = 0;
    if (buffer) glGetNamedBufferParameteri64v(buffer.id(), GL_BUFFER_SIZE, &bytes);
    return static_cast<size_t>(bytes);
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

void requireComplete(const GlFramebuffer& framebuffer, glm::ivec2 sizePx) {
    if (glCheckNamedFramebufferStatus(framebuffer.id(), GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
        throw std::runtime_error("OpenGL cannot render to a picture of " + std::to_string(sizePx.x) + " x " +
                                 std::to_string(sizePx.y) + " px; it may be too large for its memory");
}

}  // namespace curvewall
