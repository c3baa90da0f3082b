#include "renderer/resampler.h"

namespace curvewall {
namespace {

const char* defineOf(SourceFilter filter) {
    switch (filter) {
        case SourceFilter::nearest:
            return "NEAREST";
        case SourceFilter::linear:
            return "LINEAR";
        case SourceFilter::bicubic:
            return "BICUBIC";
    }
    return "";
}

GlSampler makeLinearSampler() {
    GLuint id = 0;
    glCreateSamplers(1, &id);
    GlSampler sampler(id);
    glSamplerParameteri(id, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glSamplerParameteri(id, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    return sampler;
}

}  // namespace

Resampler::Resampler(SourceFilter filter)
    : program_(makeProgram({{GL_VERTEX_SHADER, "whole_screen.vert"}, {GL_FRAGMENT_SHADER, "resample.frag"}},
                           {defineOf(filter)})),
      sampler_(makeLinearSampler()),
      emptyVertexArray_(makeVertexArray()) {}

void Resampler::record(const GlTexture& pictures, const GlTexture& places, const FrameTarget& target,
                       glm::vec3 background) const {
    target.begin(background);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_BLEND);
    for (GLenum plane = 0; plane < 8; ++plane) glDisable(GL_CLIP_DISTANCE0 + plane);
    glUseProgram(program_.id());
    glBindTextureUnit(0, pictures.id());
    glBindSampler(0, sampler_.id());
    glBindTextureUnit(1, places.id());
    glBindSampler(1, 0);
    glBindVertexArray(emptyVertexArray_.id());
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

GlTexture uploadPlaces(const std::vector<glm::vec4>& places, glm::ivec2 sizePx) {
    GlTexture texture = makeTexture2D(GL_RGBA32F, sizePx);
    glTextureSubImage2D(texture.id(), 0, 0, 0, sizePx.x, sizePx.y, GL_RGBA, GL_FLOAT, places.data());
    return texture;
}

}  // namespace curvewall
