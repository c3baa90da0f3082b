#pragma once
// Shader programs from the files of shaders/, which are built into the library.

#include "renderer/gl/gl_handle.h"

#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

namespace curvewall {

struct ShaderStage {
    GLenum type;            // GL_VERTEX_SHADER, ...
    std::string_view file;  // name within shaders/
};

// Text of a file of shaders/. Throws std::logic_error when there is none.
std::string_view shaderText(std::string_view file);
std::vector<std::string_view> shaderFiles();

// Compiles and links. `#include "x.glsl"` takes in another file of shaders/; each entry of `defines` becomes
// a #define line ("LIT", "CLIP_PLANES 2"). Throws std::runtime_error with the file and the driver's log.
GlProgram makeProgram(std::initializer_list<ShaderStage> stages,
                      const std::vector<std::string>& defines = {});

}  // namespace curvewall
