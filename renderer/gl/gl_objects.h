#pragma once
// Making OpenGL objects in one line each.

#include "renderer/gl/gl_handle.h"

#include <glm/vec2.hpp>

#include <span>

namespace curvewall {

// Immutable storage; `bytes` may be empty of data (nullptr) to reserve `size` bytes. A buffer of no bytes
// gets four, since OpenGL has no empty storage. Throws std::runtime_error when there is no memory for it.
GlBuffer makeBuffer(const void* bytes, size_t size, GLbitfield flags = 0);

template <class T>
GlBuffer makeBuffer(std::span<const T> values) {
    return makeBuffer(values.data(), values.size_bytes());
}

GlTexture makeTexture2D(GLenum internalFormat, glm::ivec2 sizePx, int levels = 1);
GlRenderbuffer makeRenderbuffer(GLenum internalFormat, glm::ivec2 sizePx, int samples = 1);
GlVertexArray makeVertexArray();
GlFramebuffer makeFramebuffer();
// The first so many clip distances are looked at, and no others.
void enableClipPlanes(int count);
void bindStorage(GLuint binding, const GlBuffer& buffer);

// Bytes, with all levels, layers and samples; 0 where there is none. A driver may take more.
size_t sizeOf(const GlBuffer& buffer);
size_t sizeOf(const GlTexture& texture);
size_t sizeOf(const GlRenderbuffer& buffer);

// Throws std::runtime_error when the driver cannot render to it, as when there is no memory for its pictures.
void requireComplete(const GlFramebuffer& framebuffer, glm::ivec2 sizePx);

}  // namespace curvewall
