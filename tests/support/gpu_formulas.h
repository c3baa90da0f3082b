#pragma once
// Formulas that GLSL and C++ share, run on the GPU in single precision.

#include "renderer/gl/gl_objects.h"
#include "tests/support/gl_fixture.h"
#include "tests/support/random_numbers.h"

#include <glm/common.hpp>
#include <glm/vec4.hpp>

#include <algorithm>
#include <array>
#include <fstream>
#include <functional>
#include <optional>
#include <span>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace curvewall::test {

inline std::string shaderText(const std::string& name) {
    const std::string path = CURVEWALL_SOURCE_DIR "/shaders/" + name + ".glsl";
    std::ifstream file(path);
    if (!file) throw std::runtime_error("cannot read " + path);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
}

inline GlProgram computeProgramOf(const std::string& text) {
    const GlShader shader(glCreateShader(GL_COMPUTE_SHADER));
    const GLchar* source = text.c_str();
    glShaderSource(shader.id(), 1, &source, nullptr);
    glCompileShader(shader.id());
    GlProgram program(glCreateProgram());
    glAttachShader(program.id(), shader.id());
    glLinkProgram(program.id());
    GLint linked = GL_FALSE;
    glGetProgramiv(program.id(), GL_LINK_STATUS, &linked);
    if (!linked) {
        std::array<GLchar, 4096> log{};
        glGetShaderInfoLog(shader.id(), log.size(), nullptr, log.data());
        throw std::runtime_error(log.data());
    }
    return program;
}

// What the shaders/ files of a fixture compute, for numbers that single precision holds.
class GpuFormulas : public GlTest {
protected:
    using Terms = std::array<float, 12>;
    using Input = std::function<glm::vec4(Random&)>;
    struct Results {
        std::vector<glm::vec4> given, found;
    };

    // Names without ".glsl", what is needed by others first.
    explicit GpuFormulas(std::vector<std::string> files) : files_(std::move(files)) {}

    void SetUp() override {
        GlTest::SetUp();
        if (!IsSkipped() && !HasFatalFailure()) context_.emplace();
    }

    // Runs `glsl`, a function body with the argument v, on many inputs.
    Results run(const std::string& glsl, const Input& input, const Terms& terms = {}) const {
        constexpr size_t kCount = 20'000;
        Random random(1);
        Results results{std::vector<glm::vec4>(kCount), std::vector<glm::vec4>(kCount)};
        std::ranges::generate(results.given, [&] { return input(random); });
        const GlBuffer in = makeBuffer(std::span<const glm::vec4>(results.given));
        const GlBuffer out = makeBuffer(std::span<const glm::vec4>(results.found));
        const GlProgram program = computeProgramOf(shaderOf(glsl));
        glUseProgram(program.id());
        glProgramUniform1fv(program.id(), 0, static_cast<GLsizei>(terms.size()), terms.data());
        bindStorage(0, in);
        bindStorage(1, out);
        glDispatchCompute(kCount / 64 + 1, 1, 1);
        glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
        glGetNamedBufferSubData(out.id(), 0, kCount * sizeof(glm::vec4), results.found.data());
        return results;
    }

    // The largest component by which `glsl` differs from `cpp`.
    double difference(const std::string& glsl, const std::function<glm::dvec4(glm::dvec4)>& cpp,
                      const Input& input, const Terms& terms = {}) const {
        const Results results = run(glsl, input, terms);
        double worst = 0;
        for (size_t i = 0; i < results.given.size(); ++i) {
            const glm::dvec4 off = glm::abs(glm::dvec4(results.found[i]) - cpp(glm::dvec4(results.given[i])));
            const double most = std::max({off.x, off.y, off.z, off.w});
            if (!(most <= worst)) worst = most;
        }
        return worst;
    }

private:
    std::string shaderOf(const std::string& formula) const {
        std::string text = R"(#version 450 core
#define SHARED_FN
#define real float
#define real2 vec2
#define real3 vec3
#define real4 vec4
#define real3x3 mat3
)";
        for (const std::string& file : files_) text += shaderText(file);
        return text + R"(
layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Given { vec4 given[]; };
layout(std430, binding = 1) writeonly buffer Found { vec4 found[]; };
layout(location = 0) uniform float terms[12];
vec4 formula(vec4 v) { )" +
               formula + R"( }
void main() {
    if (gl_GlobalInvocationID.x < given.length())
        found[gl_GlobalInvocationID.x] = formula(given[gl_GlobalInvocationID.x]);
}
)";
    }

    std::vector<std::string> files_;
    std::optional<EglContext> context_;
};

}  // namespace curvewall::test
