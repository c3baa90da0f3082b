#include "renderer/scene_programs.h"

#include "renderer/coverage.h"

#include <string>
#include <utility>
#include <vector>

namespace curvewall {

std::string outputDefine(OutputKind output) {
    switch (output) {
        case OutputKind::color:
            return "OUTPUT_COLOR";
        case OutputKind::depth:
            return "OUTPUT_DEPTH";
        case OutputKind::coverage:
            return "OUTPUT_COVERAGE";
        case OutputKind::position:
            return "OUTPUT_POSITION";
    }
    return {};
}

ScenePrograms::ScenePrograms(const Scene& scene, SceneLook look, GeometryPath path) : look_(look) {
    for (const Material& material : scene.materials) {
        const Variant variant = variantFor(material);
        if (programs_.contains(variant)) continue;
        std::vector<std::string> defines{outputDefine(look.output),
                                         "CLIP_PLANES " + std::to_string(path.clipPlanes)};
        const auto defineIf = [&](bool condition, const char* name) {
            if (condition) defines.emplace_back(name);
        };
        defineIf(path.pairs, "PAIRS");
        if (path.pairs) defines.push_back("PAIRS_PER_INSTANCE " + std::to_string(kPairsPerInstance) + "u");
        defineIf(path.right == PixelRight::owner, "OWNED");
        defineIf(path.right == PixelRight::notHoles, "HOLES");
        defineIf(variant.lit, "LIT");
        defineIf(variant.textured, "TEXTURED");
        defineIf(variant.masked, "MASKED");
        // Pairs carry their facing and the hidden ones are never made; a plain draw has to look.
        const bool checksFacing = !path.pairs && (variant.lit || variant.singleSided);
        defineIf(checksFacing, "CHECK_FACING");
        defineIf(!path.pairs && variant.singleSided, "SINGLE_SIDED");
        GlProgram program =
            makeProgram({{GL_VERTEX_SHADER, "scene.vert"}, {GL_FRAGMENT_SHADER, "scene.frag"}}, defines);
        programs_.emplace(variant, Entry{std::move(program), checksFacing});
    }
}

ScenePrograms::Variant ScenePrograms::variantFor(const Material& material) const {
    const bool color = look_.output == OutputKind::color;
    const bool masked = material.alphaCutoff >= 0;
    return {.lit = color && look_.style == Style::textured && !material.unlit,
            .textured = material.texture >= 0 && (color || masked),
            .masked = masked,
            .singleSided = !material.doubleSided};
}

ScenePrograms::Chosen ScenePrograms::choose(const Material& material) const {
    const Variant variant = variantFor(material);
    const GLuint program = programs_.at(variant).program.id();
    glUseProgram(program);
    glProgramUniform4fv(program, 10, 1, &material.baseColor[0]);
    if (variant.masked) glProgramUniform1f(program, 11, material.alphaCutoff);
    return {program, variant.textured};
}

void ScenePrograms::setFrame(const SceneView& view, bool frontIsClockwise, glm::vec2 shiftInClipSpace) const {
    for (const auto& [variant, entry] : programs_) {
        const GLuint program = entry.program.id();
        glProgramUniformMatrix3fv(program, 0, 1, GL_FALSE, &view.wallFromScene[0][0]);
        glProgramUniform3fv(program, 1, 1, &view.originFromEyeM[0]);
        glProgramUniform1f(program, 9, kNearFraction);
        glProgramUniform2fv(program, 14, 1, &shiftInClipSpace[0]);
        if (entry.checksFacing) glProgramUniform1i(program, 12, frontIsClockwise);
    }
}

}  // namespace curvewall
