#include "renderer/sampled_target.h"

#include "renderer/sample_pattern.h"

#include <cmath>

namespace curvewall {
namespace {

int mostHardwareSamples() {
    GLint most = 1;
    glGetIntegerv(GL_MAX_SAMPLES, &most);
    return most;
}

std::vector<FramePass> passesFor(int samples) {
    if (samples <= mostHardwareSamples()) return {FramePass{}};
    std::vector<FramePass> passes;
    // A sample stands for an area of 1 / samples of the pixel.
    const float lodBias = -0.5f * std::log2(static_cast<float>(samples));
    for (const glm::dvec2 offset : samplePattern(samples, 0))
        passes.push_back({.shiftPx = glm::vec2(0.5 - offset),
                          .firstSample = static_cast<int>(passes.size()),
                          .lodBias = lodBias});
    return passes;
}

}  // namespace

SampledTarget::SampledTarget(glm::ivec2 sizePx, TargetFormat format, int samples)
    : passes_(passesFor(samples)), target_(sizePx, format, passes_.size() > 1 ? 1 : samples) {
    passes_.front().samples = target_.samples();
    if (passes_.size() == 1) return;
    sum_.emplace(sizePx, TargetFormat{OutputKind::color, true}, 1);
    addProgram_ =
        makeProgram({{GL_VERTEX_SHADER, "whole_screen.vert"}, {GL_FRAGMENT_SHADER, "add_pass.frag"}});
    glProgramUniform1f(addProgram_.id(), 0, 1 / static_cast<float>(passes_.size()));
    emptyVertexArray_ = makeVertexArray();
}

std::vector<glm::dvec2> SampledTarget::sampleOffsetsPx() const {
    std::vector<glm::dvec2> offsets;
    target_.bind();
    for (const FramePass& pass : passes_) {
        for (int i = 0; i < pass.samples; ++i) {
            glm::vec2 inPixel(0.5f);  // the picture's row 0 is the framebuffer's
            if (pass.samples > 1) glGetMultisamplefv(GL_SAMPLE_POSITION, static_cast<GLuint>(i), &inPixel[0]);
            offsets.push_back(glm::dvec2(inPixel - pass.shiftPx));
        }
    }
    return offsets;
}

void SampledTarget::draw(glm::vec3 background, const std::function<void(const FramePass&)>& record) const {
    if (sum_) sum_->begin(glm::vec3(0));
    for (const FramePass& pass : passes_) {
        target_.begin(background);
        record(pass);
        target_.end();
        if (sum_) addPass();
    }
}

void SampledTarget::addPass() const {
    sum_->bind();
    glDisable(GL_DEPTH_TEST);
    glEnable(GL_BLEND);
    glBlendFunc(GL_ONE, GL_ONE);
    enableClipPlanes(0);
    glUseProgram(addProgram_.id());
    glBindTextureUnit(0, target_.texture().id());
    glBindSampler(0, 0);
    glBindVertexArray(emptyVertexArray_.id());
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

}  // namespace curvewall
