#pragma once
// The framebuffer that a frame is drawn into, and the way back to memory.

#include "renderer/frame.h"
#include "renderer/gl/gl_objects.h"
#include "renderer/look.h"

#include <glm/vec3.hpp>

namespace curvewall {

// What the texels of an output hold.
struct TargetFormat {
    OutputKind output = OutputKind::color;
    bool linear = false;  // colour in float rather than 8-bit sRGB

    bool operator==(const TargetFormat&) const = default;
};

GLenum internalFormatOf(TargetFormat format);

// Row 0 of the framebuffer is the picture's top row. Colour is blended, resolved and cleared in linear light.
class FrameTarget {
public:
    // With samples > 1, at most as many as the driver has, the frame is drawn multisampled and resolved.
    FrameTarget(glm::ivec2 sizePx, TargetFormat format, int samples);

    // Makes it the framebuffer that is drawn into.
    void bind() const;
    // Binds, clears to the background or to the output's "nothing", and sets the state for drawing a scene.
    void begin(glm::vec3 background) const;
    // Resolves the samples, where there are any.
    void end() const;
    // Copies the finished picture into a framebuffer of its size.
    void copyInto(GLuint framebuffer) const;

    // Waits for the GPU. Never within a frame.
    Frame read() const;

    glm::ivec2 sizePx() const { return sizePx_; }
    int samples() const;  // of a pixel; a driver may take more than it was asked for
    size_t memoryBytes() const;
    const GlTexture& texture() const { return texture_; }

private:
    const GlFramebuffer& drawnInto() const { return drawFramebuffer_ ? drawFramebuffer_ : framebuffer_; }

    glm::ivec2 sizePx_;
    TargetFormat format_;
    GlTexture texture_;
    GlRenderbuffer depth_, multisampleColor_;
    GlFramebuffer framebuffer_, drawFramebuffer_;  // the second only where there are samples to resolve
};

// The state that every scene pass starts from: reversed depth, no culling, additive for coverage.
void setSceneState(OutputKind output);
// Clears the bound framebuffer's colour and depth.
void clearTarget(GLuint framebuffer, OutputKind output, glm::vec3 background);

}  // namespace curvewall
