#include "renderer/lens_rays.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace curvewall {
namespace {

GlTexture makeRays(glm::ivec2 sizePx, int samples) {
    GLuint id = 0;
    glCreateTextures(GL_TEXTURE_2D_ARRAY, 1, &id);
    GlTexture texture(id);
    glTextureStorage3D(id, 1, GL_RGBA32F, sizePx.x, sizePx.y, samples);
    if (glGetError() == GL_OUT_OF_MEMORY)
        throw std::runtime_error("OpenGL has no room for the rays of " + std::to_string(sizePx.x) + " x " +
                                 std::to_string(sizePx.y) + " px with " + std::to_string(samples) +
                                 " samples each");
    glTextureParameteri(id, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTextureParameteri(id, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    return texture;
}

void set(GLuint program, GLint location, glm::vec2 value) {
    glProgramUniform2fv(program, location, 1, &value[0]);
}

}  // namespace

LensRays::LensRays(const RoundLens& lens, int samples)
    : lens_(lens),
      texture_(makeRays(lens.sizePx, samples)),
      program_(makeProgram({{GL_COMPUTE_SHADER, "lens_rays.comp"}},
                           {"LENS " + std::to_string(static_cast<int>(lens.function.model)),
                            "MOST_SAMPLES " + std::to_string(samples)})) {
    const GLuint program = program_.id();
    const std::vector<float> coefficients(lens.function.coefficients.begin(),
                                          lens.function.coefficients.end());
    glProgramUniform1fv(program, 0, static_cast<GLsizei>(coefficients.size()), coefficients.data());
    set(program, 9, glm::vec2(lens.centrePx));
    set(program, 10, glm::vec2(lens.focalPx));
    glProgramUniform1f(program, 11, static_cast<float>(lens.edgeRad));
    glProgramUniform1f(program, 12, static_cast<float>(lens.function.radius(lens.edgeRad)));
}

void LensRays::fill(std::span<const glm::dvec2> offsetsPx) {
    if (std::ranges::equal(offsetsPx, filledAt_)) return;
    filledAt_.assign(offsetsPx.begin(), offsetsPx.end());
    for (size_t i = 0; i < offsetsPx.size(); ++i)
        set(program_.id(), 13 + static_cast<GLint>(i), glm::vec2(offsetsPx[i]));
    constexpr GLuint kGroupPx = 8;
    const auto groups = [](int pixels) { return (static_cast<GLuint>(pixels) + kGroupPx - 1) / kGroupPx; };
    glUseProgram(program_.id());
    glBindImageTexture(0, texture_.id(), 0, GL_TRUE, 0, GL_WRITE_ONLY, GL_RGBA32F);
    glDispatchCompute(groups(lens_.sizePx.x), groups(lens_.sizePx.y), static_cast<GLuint>(offsetsPx.size()));
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
}

}  // namespace curvewall
