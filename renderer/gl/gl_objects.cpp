#include "renderer/gl/gl_objects.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace curvewall {

GlBuffer makeBuffer(const void* bytes, size_t size, GLbitfield flags) {
    GLuint id = 0;
    glCreateBuffers(1, &id);
    GlBuffer buffer(id);
    glNamedBufferStorage(id, static_cast<GLsizeiptr>(std::max<size_t>(size, 4)), size == 0 ? nullptr : bytes,
                         flags);
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

void requireComplete(const GlFramebuffer& framebuffer) {
    const GLenum status = glCheckNamedFramebufferStatus(framebuffer.id(), GL_FRAMEBUFFER);
    if (status != GL_FRAMEBUFFER_COMPLETE)
        throw std::runtime_error("OpenGL cannot render to this framebuffer (status " +
                                 std::to_string(status) + ")");
}

}  // namespace curvewall
