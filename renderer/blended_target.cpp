#include "renderer/blended_target.h"

#include "renderer/blending.h"

#include <utility>

namespace curvewall {
namespace {

GlTexture uploadMap(const std::vector<glm::vec3>& map, glm::ivec2 sizePx) {
    GlTexture texture = makeTexture2D(GL_RGB32F, sizePx);
    glTextureSubImage2D(texture.id(), 0, 0, 0, sizePx.x, sizePx.y, GL_RGB, GL_FLOAT, map.data());
    return texture;
}

}  // namespace

GpuBlend uploadBlend(const BlendMaps& maps, glm::ivec2 sizePx) {
    GpuBlend gpu;
    std::vector<std::string> defines;
    if (!maps.alpha.empty()) {
        gpu.alpha = uploadMap(maps.alpha, sizePx);
        defines.emplace_back("ALPHA");
    }
    if (!maps.beta.empty()) {
        gpu.beta = uploadMap(maps.beta, sizePx);
        defines.emplace_back("BETA");
    }
    gpu.program =
        makeProgram({{GL_VERTEX_SHADER, "whole_screen.vert"}, {GL_FRAGMENT_SHADER, "blend.frag"}}, defines);
    return gpu;
}

BlendedTarget::BlendedTarget(glm::ivec2 sizePx, TargetFormat format, std::shared_ptr<const GpuBlend> maps)
    : format_(format), maps_(std::move(maps)) {
    if (!maps_) return;
    target_.emplace(sizePx, format, 1);
    emptyVertexArray_ = makeVertexArray();
}

TargetFormat BlendedTarget::pictureFormat() const {
    return target_ ? TargetFormat{OutputKind::color, true} : format_;
}

size_t BlendedTarget::memoryBytes() const { return target_ ? target_->memoryBytes() : 0; }

size_t BlendedTarget::mapBytes() const { return maps_ ? sizeOf(maps_->alpha) + sizeOf(maps_->beta) : 0; }

void BlendedTarget::record(const FrameTarget& picture) const {
    if (!target_) return;
    target_->bind();
    glEnable(GL_FRAMEBUFFER_SRGB);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_BLEND);
    for (GLenum plane = 0; plane < 8; ++plane) glDisable(GL_CLIP_DISTANCE0 + plane);
    glUseProgram(maps_->program.id());
    glProgramUniform1f(maps_->program.id(), 0, mostLight(format_.linear));
    const GLuint textures[] = {picture.texture().id(), maps_->alpha.id(), maps_->beta.id()};
    for (GLuint unit = 0; unit < 3; ++unit) {
        glBindTextureUnit(unit, textures[unit]);
        glBindSampler(unit, 0);
    }
    glBindVertexArray(emptyVertexArray_.id());
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

}  // namespace curvewall
