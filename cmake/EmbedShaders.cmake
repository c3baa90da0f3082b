# Writes a header with the text of every file in shaders/, so that the program runs from anywhere.
# cmake -DSHADERS=a.glsl;b.frag -DOUTPUT=shader_files.h -P EmbedShaders.cmake
set(entries "")
foreach(path IN LISTS SHADERS)
    get_filename_component(name ${path} NAME)
    file(READ ${path} text)
    string(APPEND entries "    {\"${name}\", R\"glsl(${text})glsl\"},\n")
endforeach()
file(WRITE ${OUTPUT} "#pragma once\n// Generated from shaders/ by cmake/EmbedShaders.cmake.\n#include <string_view>\n
namespace curvewall {\nstruct ShaderFile {\n    std::string_view name;\n    std::string_view text;\n};\n
inline constexpr ShaderFile kShaderFiles[] = {\n${entries}};\n}  // namespace curvewall\n")
