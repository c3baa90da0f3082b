#pragma once
// Owners of OpenGL names.

#include <epoxy/gl.h>

#include <utility>

namespace curvewall {

// Sole owner of one OpenGL name; its context must be current when it is destroyed.
template <void (*Delete)(GLuint)>
class GlHandle {
public:
    GlHandle() = default;
    explicit GlHandle(GLuint id) : id_(id) {}
    GlHandle(GlHandle&& other) noexcept : id_(std::exchange(other.id_, 0)) {}
    GlHandle& operator=(GlHandle&& other) noexcept {
        std::swap(id_, other.id_);
        return *this;
    }
    ~GlHandle() {
        if (id_ != 0) Delete(id_);
    }

    GLuint id() const { return id_; }
    explicit operator bool() const { return id_ != 0; }

private:
    GLuint id_ = 0;
};

inline void deleteTexture(GLuint id) { glDeleteTextures(1, &id); }
inline void deleteBuffer(GLuint id) { glDeleteBuffers(1, &id); }
inline void deleteFramebuffer(GLuint id) { glDeleteFramebuffers(1, &id); }
inline void deleteRenderbuffer(GLuint id) { glDeleteRenderbuffers(1, &id); }
inline void deleteVertexArray(GLuint id) { glDeleteVertexArrays(1, &id); }
inline void deleteSampler(GLuint id) { glDeleteSamplers(1, &id); }
inline void deleteQuery(GLuint id) { glDeleteQueries(1, &id); }
inline void deleteShader(GLuint id) { glDeleteShader(id); }
inline void deleteProgram(GLuint id) { glDeleteProgram(id); }

using GlTexture = GlHandle<deleteTexture>;
using GlBuffer = GlHandle<deleteBuffer>;
using GlFramebuffer = GlHandle<deleteFramebuffer>;
using GlRenderbuffer = GlHandle<deleteRenderbuffer>;
using GlVertexArray = GlHandle<deleteVertexArray>;
using GlSampler = GlHandle<deleteSampler>;
using GlQuery = GlHandle<deleteQuery>;
using GlShader = GlHandle<deleteShader>;
using GlProgram = GlHandle<deleteProgram>;

}  // namespace curvewall
