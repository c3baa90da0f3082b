#include "renderer/scene_programs.h"

#include "renderer/gpu_pieces.h"
#include "renderer/pair_drawing.h"

#include <algorithm>
#include <cmath>
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

GlProgram sceneProgram(CornerSource source, const std::vector<std::string>& defines) {
    switch (source) {
        case CornerSource::plain:
        case CornerSource::loop:
        case CornerSource::pairs:
            break;
        case CornerSource::tessellated:
            return makeProgram({{GL_VERTEX_SHADER, "replicate.vert"},
                                {GL_TESS_CONTROL_SHADER, "replicate.tesc"},
                                {GL_TESS_EVALUATION_SHADER, "replicate.tese"},
                                {GL_GEOMETRY_SHADER, "replicate.geom"},
                                {GL_FRAGMENT_SHADER, "scene.frag"}},
                               defines);
        case CornerSource::warped:
            return makeProgram({{GL_VERTEX_SHADER, "warp.vert"}, {GL_FRAGMENT_SHADER, "scene.frag"}},
                               defines);
        case CornerSource::warpedTessellated:
            return makeProgram({{GL_VERTEX_SHADER, "warp.vert"},
                                {GL_TESS_CONTROL_SHADER, "warp.tesc"},
                                {GL_TESS_EVALUATION_SHADER, "warp.tese"},
                                {GL_FRAGMENT_SHADER, "scene.frag"}},
                               defines);
    }
    return makeProgram({{GL_VERTEX_SHADER, "scene.vert"}, {GL_FRAGMENT_SHADER, "scene.frag"}}, defines);
}

ScenePrograms::ScenePrograms(const Scene& scene, SceneLook look, GeometryPath path)
    : look_(look), drawsEdges_(curvewall::drawsEdges(look.style, look.output)) {
    if (path.closesHoles)
        forHoles_ = makeProgram({{GL_VERTEX_SHADER, "holes.vert"}, {GL_FRAGMENT_SHADER, "holes.frag"}});
    for (const Material& material : scene.materials) {
        const Variant variant = variantFor(material);
        if (programs_.contains(variant)) continue;
        std::vector<std::string> defines{outputDefine(look.output),
                                         "CLIP_PLANES " + std::to_string(path.clipPlanes)};
        const auto defineIf = [&](bool condition, const char* name) {
            if (condition) defines.emplace_back(name);
        };
        defines.insert(defines.end(), path.screenMap.begin(), path.screenMap.end());
        const bool warped =
            path.source == CornerSource::warped || path.source == CornerSource::warpedTessellated;
        const bool pairs = warped || path.source == CornerSource::pairs;
        defineIf(pairs, "PAIRS");
        defineIf(path.source == CornerSource::warpedTessellated, "TESSELLATED");
        if (pairs) defines.push_back("PAIRS_PER_INSTANCE " + std::to_string(kPairsPerInstance) + "u");
        defineIf(path.source == CornerSource::loop, "LOOP");
        const bool tessellated = path.source == CornerSource::tessellated;
        // Parts of a warped triangle share no pixel.
        const bool sharesPixels = path.source != CornerSource::plain && !warped;
        const bool owned = path.singleCover || (variant.blended && sharesPixels);
        defineIf(owned, "OWNED");
        if (owned) defines.push_back("OWNER_SAMPLES " + std::to_string(path.ownerSamples));
        defineIf(variant.blended, "BLENDED");
        defineIf(drawsEdges_, "EDGES");
        defineIf(look.style == Style::wireframe, "WIREFRAME");
        defineIf(variant.lit, "LIT");
        defineIf(variant.textured, "TEXTURED");
        defineIf(variant.masked, "MASKED");
        // Replications carry their facing and the hidden ones are never made; a plain draw has to look.
        const bool checksFacing = !pairs && !tessellated && (variant.lit || variant.singleSided);
        defineIf(checksFacing, "CHECK_FACING");
        defineIf(!pairs && variant.singleSided, "SINGLE_SIDED");
        programs_.emplace(variant, Entry{sceneProgram(path.source, defines), checksFacing, owned});
    }
}

ScenePrograms::Variant ScenePrograms::variantFor(const Material& material) const {
    const bool color = look_.output == OutputKind::color;
    const bool masked = material.alphaCutoff >= 0;
    return {.lit = color && look_.style != Style::unlit && !material.unlit,
            .textured = material.texture >= 0 && (color || masked),
            .masked = masked,
            .singleSided = !material.doubleSided,
            .blended = color && material.blending != Blending::none};
}

ScenePrograms::Chosen ScenePrograms::choose(const Material& material) const {
    const Variant variant = variantFor(material);
    const GLuint program = programs_.at(variant).program.id();
    glUseProgram(program);
    glProgramUniform4fv(program, 10, 1, &material.baseColor[0]);
    if (variant.masked) glProgramUniform1f(program, 11, material.alphaCutoff);
    return {program, variant.textured, variant.blended};
}

std::vector<std::string> ScenePrograms::attributes() const {
    const auto some = [this](bool Variant::*property) {
        return std::ranges::any_of(programs_, [&](const auto& program) { return program.first.*property; });
    };
    std::vector<std::string> fetched{"position"};
    if (some(&Variant::lit)) fetched.emplace_back("normal");
    if (some(&Variant::textured)) fetched.insert(fetched.end(), {"uv", "texture"});
    if (drawsEdges_) fetched.emplace_back("edges");
    return fetched;
}

void ScenePrograms::setFrame(const SceneView& view, glm::ivec2 sizePx, const FramePass& pass) const {
    const glm::vec2 shiftInClipSpace = 2.0f * pass.shiftPx / glm::vec2(sizePx);
    const glm::vec3 sampling(pass.shiftPx, std::exp2(pass.lodBias));
    for (const auto& [variant, entry] : programs_) {
        const GLuint program = entry.program.id();
        glProgramUniformMatrix3fv(program, 0, 1, GL_FALSE, &view.wallFromScene[0][0]);
        glProgramUniform3fv(program, 1, 1, &view.originFromEyeM[0]);
        glProgramUniform1f(program, 9, kNearFraction);
        glProgramUniform2fv(program, 14, 1, &shiftInClipSpace[0]);
        if (entry.owned) glProgramUniform1i(program, 17, pass.firstSample);
        if (drawsEdges_) glProgramUniform3fv(program, 22, 1, &sampling[0]);
    }
}

void ScenePrograms::setFacing(bool frontIsClockwise) const {
    for (const auto& [variant, entry] : programs_) setFacing(entry.program.id(), frontIsClockwise);
}

void ScenePrograms::setFacing(GLuint program, bool frontIsClockwise) const {
    for (const auto& [variant, entry] : programs_)
        if (entry.program.id() == program && entry.checksFacing)
            glProgramUniform1i(program, 12, frontIsClockwise);
}

}  // namespace curvewall
