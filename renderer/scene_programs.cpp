#include "renderer/scene_programs.h"

#include "renderer/gpu_pieces.h"
#include "renderer/pair_drawing.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

namespace curvewall {
namespace {

// Bounding shapes reach so far beyond what they bound: the rasterizer rounds corners to its grid, which
// OpenGL wants to have 16 lines a pixel at least, and positions in clip space have the roundings of single
// precision.
double boundsGuardPx() {
    GLint subpixelBits = 4;
    glGetIntegerv(GL_SUBPIXEL_BITS, &subpixelBits);
    constexpr double kClipSpaceRoundingPx = 1.0 / 256;
    return std::exp2(-subpixelBits) + kClipSpaceRoundingPx;
}

std::vector<std::string> definesOf(const BoundedPath& path) {
    const bool isQuad = path.shape != BoundingShape::triangle;
    const int corners = (isQuad ? 4 : 12) + (path.isWide ? 12 : 0);
    std::vector<std::string> defines{"LENS " + std::to_string(static_cast<int>(path.lens)),
                                     "MOST_CORNERS " + std::to_string(corners)};
    if (path.shape == BoundingShape::quad) defines.emplace_back("BOUNDS_QUAD quadBounds");
    if (path.shape == BoundingShape::genericQuad) defines.emplace_back("BOUNDS_QUAD genericBounds");
    if (path.isWide) defines.emplace_back("WIDE");
    if (!isQuad || path.isWide) defines.emplace_back("PARTED");
    if (path.perSample) defines.emplace_back("PER_SAMPLE");
    if (path.fragments == BoundedPath::Fragments::covered) defines.emplace_back("COUNTS_COVERED");
    if (path.fragments == BoundedPath::Fragments::hits) defines.emplace_back("COUNTS_HITS");
    return defines;
}

void setLens(GLuint program, const RoundLens& lens) {
    const std::vector<float> coefficients(lens.function.coefficients.begin(),
                                          lens.function.coefficients.end());
    const glm::dvec2 sizePx(lens.sizePx);
    const glm::vec2 centre(2.0 * lens.centrePx / sizePx - 1.0);
    const glm::vec2 focal(glm::dvec2(2, -2) * lens.focalPx / sizePx);
    const glm::mat3 wallFromLens(lens.wallFromLens);
    glProgramUniform1fv(program, 30, static_cast<GLsizei>(coefficients.size()), coefficients.data());
    glProgramUniform2fv(program, 39, 1, &centre[0]);
    glProgramUniform2fv(program, 40, 1, &focal[0]);
    glProgramUniform1f(program, 41, static_cast<float>(lens.edgeRad));
    glProgramUniform1f(program, 42,
                       static_cast<float>(boundsGuardPx() / std::min(lens.focalPx.x, lens.focalPx.y)));
    glProgramUniformMatrix3fv(program, 43, 1, GL_FALSE, &wallFromLens[0][0]);
}

}  // namespace

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
        case CornerSource::layered:
            return makeProgram({{GL_VERTEX_SHADER, "scene.vert"},
                                {GL_GEOMETRY_SHADER, "layered.geom"},
                                {GL_FRAGMENT_SHADER, "scene.frag"}},
                               defines);
        case CornerSource::bounded:
            return makeProgram({{GL_VERTEX_SHADER, "bounded.vert"},
                                {GL_GEOMETRY_SHADER, "bounded.geom"},
                                {GL_FRAGMENT_SHADER, "bounded.frag"}},
                               defines);
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
        const bool layered = path.source == CornerSource::layered;
        defineIf(layered, "LAYERED");
        if (layered) defines.push_back("LAYERS " + std::to_string(path.layers));
        const bool tessellated = path.source == CornerSource::tessellated;
        const bool bounded = path.source == CornerSource::bounded;
        if (bounded) std::ranges::move(definesOf(path.bounded), std::back_inserter(defines));
        // Parts of a warped triangle share no pixel, nor do what bounding shapes show.
        const bool sharesPixels = path.source != CornerSource::plain && !layered && !bounded && !warped;
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
        const bool checksFacing = !pairs && !tessellated && !bounded && (variant.lit || variant.singleSided);
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

void ScenePrograms::setFrame(const SceneView& view, const RoundLens& lens, const FramePass& pass) const {
    setFrame(view, lens.sizePx, pass);
    for (const auto& [variant, entry] : programs_) setLens(entry.program.id(), lens);
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
