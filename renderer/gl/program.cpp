#include "renderer/gl/program.h"

#include "renderer/gl/shader_files.h"

#include <algorithm>
#include <array>
#include <stdexcept>

namespace curvewall {
namespace {

// Replaces include lines by the file they name; #line keeps the driver's messages pointing at the right line.
std::string expandIncludes(std::string_view text) {
    std::string out;
    int lineNumber = 0;
    for (size_t begin = 0; begin < text.size();) {
        const size_t end = std::min(text.find('\n', begin), text.size());
        const std::string_view line = text.substr(begin, end - begin);
        begin = end + 1;
        ++lineNumber;
        constexpr std::string_view kInclude = "#include \"";
        if (line.starts_with(kInclude)) {
            const std::string_view file = line.substr(kInclude.size(), line.rfind('"') - kInclude.size());
            out += "#line 1\n" + expandIncludes(shaderText(file)) + "#line " +
                   std::to_string(lineNumber + 1) + "\n";
        } else {
            out.append(line).append("\n");
        }
    }
    return out;
}

template <auto GetParameter, auto GetLog>
std::string logOf(GLuint id) {
    GLint length = 0;
    GetParameter(id, GL_INFO_LOG_LENGTH, &length);
    std::string log(static_cast<size_t>(length), '\0');
    if (length > 0) GetLog(id, length, nullptr, log.data());
    return log;
}

void getShader(GLuint id, GLenum name, GLint* value) { glGetShaderiv(id, name, value); }
void getShaderLog(GLuint id, GLsizei size, GLsizei* length, GLchar* log) {
    glGetShaderInfoLog(id, size, length, log);
}
void getProgram(GLuint id, GLenum name, GLint* value) { glGetProgramiv(id, name, value); }
void getProgramLog(GLuint id, GLsizei size, GLsizei* length, GLchar* log) {
    glGetProgramInfoLog(id, size, length, log);
}

GlShader compile(const ShaderStage& stage, const std::vector<std::string>& defines) {
    std::string header = "#version 450 core\n#define SHARED_FN\n";
    for (const std::string& define : defines) header += "#define " + define + "\n";
    header += "#line 1\n";
    const std::string body = expandIncludes(shaderText(stage.file));
    const std::array<const GLchar*, 2> sources{header.c_str(), body.c_str()};

    GlShader shader(glCreateShader(stage.type));
    glShaderSource(shader.id(), sources.size(), sources.data(), nullptr);
    glCompileShader(shader.id());
    GLint compiled = GL_FALSE;
    glGetShaderiv(shader.id(), GL_COMPILE_STATUS, &compiled);
    if (!compiled)
        throw std::runtime_error("shaders/" + std::string(stage.file) + ": " +
                                 logOf<getShader, getShaderLog>(shader.id()));
    return shader;
}

}  // namespace

std::string_view shaderText(std::string_view file) {
    const auto found = std::ranges::find(kShaderFiles, file, &ShaderFile::name);
    if (found == std::end(kShaderFiles)) throw std::logic_error("no file shaders/" + std::string(file));
    return found->text;
}

std::vector<std::string_view> shaderFiles() {
    std::vector<std::string_view> names;
    for (const ShaderFile& file : kShaderFiles) names.push_back(file.name);
    return names;
}

GlProgram makeProgram(std::initializer_list<ShaderStage> stages, const std::vector<std::string>& defines) {
    GlProgram program(glCreateProgram());
    std::string files;
    for (const ShaderStage& stage : stages) {
        const GlShader shader = compile(stage, defines);
        glAttachShader(program.id(), shader.id());
        files += " shaders/" + std::string(stage.file);
    }
    glLinkProgram(program.id());
    GLint linked = GL_FALSE;
    glGetProgramiv(program.id(), GL_LINK_STATUS, &linked);
    if (!linked)
        throw std::runtime_error("linking" + files + ": " + logOf<getProgram, getProgramLog>(program.id()));
    return program;
}

}  // namespace curvewall
