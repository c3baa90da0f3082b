#pragma once
// Making OpenGL objects in one line each.

#include "renderer/gl/gl_handle.h"

#include <glm/vec2.hpp>

#include <span>

namespace curvewall {

// Immutable storage; `bytes` may be empty of data (nullptr) to reserve `size` bytes. A buffer of no bytes
// gets four, since OpenGL has no empty storage.
GlBuffer makeBuffer(const void* bytes, size_t size, GLbitfield flags = 0);

template <class T>
GlBuffer makeBuffer(std::span<const T> values) {
    return makeBuffer(values.data(), values.size_bytes());
}

GlTexture makeTexture2D(GLenum internalFormat, glm::ivec2 sizePx, int levels = 1);
GlVertexArray makeVertexArray();
GlFramebuffer makeFramebuffer();

// Throws std::runtime_error when the driver cannot render to it.
void requireComplete(const GlFramebuffer& framebuffer);

}  // namespace curvewall
