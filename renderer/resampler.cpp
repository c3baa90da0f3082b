#include "renderer/resampler.h"

#include "calibration/errors.h"

#include <glm/common.hpp>

#include <string>
#include <string_view>

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
        case SourceFilter::mipmap:
            return "MIPMAP";
        case SourceFilter::anisotropic:
            return "ANISOTROPIC";
    }
    return "";
}

GlProgram programFor(SourceFilter filter, SourceLookup lookup) {
    const bool isMesh = lookup == SourceLookup::mesh;
    std::vector<std::string> defines{defineOf(filter)};
    if (isMesh) defines.emplace_back("MESH");
    const std::string_view vertices = isMesh ? "lookup_mesh.vert" : "whole_screen.vert";
    return makeProgram({{GL_VERTEX_SHADER, vertices}, {GL_FRAGMENT_SHADER, "resample.frag"}}, defines);
}

GlSampler makeSampler(SourceFilter filter) {
    GLuint id = 0;
    glCreateSamplers(1, &id);
    GlSampler sampler(id);
    glSamplerParameteri(id, GL_TEXTURE_MIN_FILTER, usesLevels(filter) ? GL_LINEAR_MIPMAP_LINEAR : GL_LINEAR);
    glSamplerParameteri(id, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glSamplerParameteri(id, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glSamplerParameteri(id, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    return sampler;
}

GlTexture uploadPixels(const std::vector<glm::vec4>& pixels, GLenum format, glm::ivec2 sizePx) {
    GlTexture texture = makeTexture2D(format, sizePx);
    glTextureSubImage2D(texture.id(), 0, 0, 0, sizePx.x, sizePx.y, GL_RGBA, GL_FLOAT, pixels.data());
    return texture;
}

}  // namespace

Resampler::Resampler(SourceFilter filter, SourceLookup lookup)
    : lookup_(lookup),
      program_(programFor(filter, lookup)),
      sampler_(makeSampler(filter)),
      emptyVertexArray_(makeVertexArray()) {}

void Resampler::record(const GlTexture& pictures, const GpuLookup& lookup, const FrameTarget& target,
                       glm::vec3 background) const {
    target.begin(background);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_BLEND);
    for (GLenum plane = 0; plane < 8; ++plane) glDisable(GL_CLIP_DISTANCE0 + plane);
    glUseProgram(program_.id());
    glBindTextureUnit(0, pictures.id());
    glBindSampler(0, sampler_.id());
    glBindVertexArray(emptyVertexArray_.id());
    if (lookup_ == SourceLookup::mesh) {
        const glm::vec2 sizePx(target.sizePx());
        glProgramUniform2fv(program_.id(), 0, 1, &sizePx[0]);
        bindStorage(0, lookup.cells);
        glDrawArrays(GL_TRIANGLES, 0, 6 * lookup.cellCount);
        return;
    }
    glBindTextureUnit(1, lookup.places.id());
    glBindTextureUnit(2, lookup.gradients.id());
    glBindSampler(1, 0);
    glBindSampler(2, 0);
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

GpuLookup uploadLookup(const std::vector<glm::vec4>& places, const std::vector<glm::vec4>& gradients,
                       glm::ivec2 sizePx) {
    GpuLookup gpu;
    gpu.places = uploadPixels(places, GL_RGBA32F, sizePx);
    if (gradients.empty()) return gpu;
    // Half floats end at 65504, which is far beyond what is used.
    std::vector<glm::vec4> bounded = gradients;
    constexpr float kMost = 1000;
    for (glm::vec4& gradient : bounded) gradient = glm::clamp(gradient, glm::vec4(-kMost), glm::vec4(kMost));
    gpu.gradients = uploadPixels(bounded, GL_RGBA16F, sizePx);
    return gpu;
}

// As lookup_mesh.vert reads them.
GpuLookup uploadLookup(const std::vector<LookupCell>& mesh) {
    std::vector<glm::vec4> cells;
    for (const LookupCell& cell : mesh) {
        const auto& places = cell.places;
        cells.insert(
            cells.end(),
            {glm::vec4(cell.fromPx, cell.toPx), glm::vec4(glm::vec2(places[0]), glm::vec2(places[1])),
             glm::vec4(glm::vec2(places[2]), glm::vec2(places[3])), glm::vec4(cell.face, 0, 0, 0)});
    }
    GLint64 mostBytes = 0;
    glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &mostBytes);
    if (cells.size() * sizeof(glm::vec4) > static_cast<uint64_t>(mostBytes))
        throw UsageError("a mesh of " + std::to_string(mesh.size()) +
                         " cells is more than this OpenGL holds; take a larger mesh step");
    GpuLookup gpu;
    gpu.cells = makeBuffer(std::span<const glm::vec4>(cells));
    gpu.cellCount = static_cast<GLsizei>(mesh.size());
    return gpu;
}

}  // namespace curvewall
