#include "renderer/stroke_renderer.h"

#include "renderer/frame_target.h"
#include "renderer/pair_drawing.h"
#include "renderer/strokes.h"

#include <glm/geometric.hpp>
#include <glm/vec4.hpp>

#include <algorithm>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace curvewall {
namespace {

// A stroke whose middle is farther outside leaves no trace on the display.
constexpr double kBorderPx = 2;
static_assert(kBorderPx > kPointSizePx / 2 && kBorderPx > kLineWidthPx / 2);

// A scene of nothing but strokes, as triangles without area. Those of a material follow each other, points
// first.
ScenePtr flatTriangles(const Scene& scene) {
    auto flat = std::make_shared<Scene>();
    flat->originM = scene.originM;
    flat->materials = scene.materials;
    for (Material& material : flat->materials) {
        material.doubleSided = true;         // a line has no back
        material.blending = Blending::none;  // and is not sorted
    }
    std::map<uint32_t, uint32_t> indexOf;
    const auto vertex = [&](uint32_t index) {
        const auto [entry, isNew] = indexOf.try_emplace(index, static_cast<uint32_t>(flat->positions.size()));
        if (isNew) {
            flat->positions.push_back(scene.positions[index]);
            flat->normals.push_back(scene.normals[index]);
            flat->uvs.push_back(scene.uvs[index]);
        }
        return entry->second;
    };
    const auto add = [&](const StrokeRange& range, const auto& verticesOf) {
        flat->ranges.push_back({range.material, static_cast<uint32_t>(flat->triangles.size()), range.count});
        for (uint32_t i = range.first; i < range.first + range.count; ++i) {
            const glm::uvec2 ends = verticesOf(i);
            const uint32_t from = vertex(ends.x), to = vertex(ends.y);
            flat->triangles.emplace_back(from, to, to);
        }
    };
    for (const StrokeRange& range : scene.pointRanges)
        add(range, [&](uint32_t i) { return glm::uvec2(scene.points[i]); });
    for (const StrokeRange& range : scene.lineRanges) add(range, [&](uint32_t i) { return scene.lines[i]; });
    return flat;
}

// The plane through the eye and an edge, the same from both its sides but for its sign. w: whether what lies
// exactly in it belongs to this side (1) or to the other (-1).
glm::vec4 sharedPlane(const PieceMesh& mesh, const Piece& piece, PieceEdge edge) {
    uint32_t a = piece.vertices[edge.from], b = piece.vertices[edge.to];
    if (a > b) std::swap(a, b);
    const glm::vec3 plane(glm::normalize(glm::cross(mesh.vertices[a].m, mesh.vertices[b].m)));
    glm::dvec3 middle(0);
    for (uint32_t i = 0; i < piece.vertexCount; ++i) middle += mesh.vertices[piece.vertices[i]].m;
    const float side = glm::dot(glm::dvec3(plane), middle) > 0 ? 1.0f : -1.0f;
    return {side * plane, side};
}

// Three rows of H, in pixels; the planes that the middle of a stroke is cut by where drawings of neighbours
// may overlap; and those where they may not. Zeros where there are fewer edges.
std::vector<glm::vec4> strokeRecords(const PieceMesh& mesh) {
    std::vector<glm::vec4> records;
    for (const Piece& piece : mesh.pieces) {
        const glm::dmat3 transposed = glm::transpose(piece.screenFromRay);
        for (int i = 0; i < 3; ++i) records.emplace_back(glm::vec3(transposed[i]), 0);
        const std::vector<PieceEdge> edges = edgesOf(mesh, piece);
        const std::vector<glm::dvec3> inner = edgePlanes(mesh, piece),
                                      border = edgePlanes(mesh, piece, kBorderPx);
        std::vector<glm::vec4> guarded(kMostPieceEdges, glm::vec4(0)), shared = guarded;
        for (size_t i = 0; i < edges.size(); ++i) {
            const bool isAtBorder = isOnBorder(mesh, piece, edges[i]);
            guarded[i] = glm::vec4(glm::normalize(isAtBorder ? border[i] : inner[i]), 1);
            shared[i] = isAtBorder ? guarded[i] : sharedPlane(mesh, piece, edges[i]);
        }
        records.insert(records.end(), guarded.begin(), guarded.end());
        records.insert(records.end(), shared.begin(), shared.end());
    }
    return records;
}

// What glBlendFunc means by a material that blends.
void setBlending(Blending blending) {
    glEnable(GL_BLEND);
    glBlendFunc(GL_SRC_ALPHA, blending == Blending::alpha ? GL_ONE_MINUS_SRC_ALPHA : GL_ONE);
    glDepthMask(GL_FALSE);
}

}  // namespace

bool hasStrokes(const Scene& scene) { return !scene.points.empty() || !scene.lines.empty(); }

StrokeScene::StrokeScene(const Scene& scene)
    : gpu(uploadScene(flatTriangles(scene), TriangleOrder::asGiven)), coverage(gpu.chunks) {}

StrokePieces uploadStrokePieces(const PieceMesh& mesh) {
    const std::vector<glm::vec4> records = strokeRecords(mesh);
    return {uploadPieces(mesh, kBorderPx), makeBuffer(std::span<const glm::vec4>(records))};
}

size_t memoryBytesOf(const StrokePieces& pieces) {
    return memoryBytesOf(pieces.found) + sizeOf(pieces.pieces);
}

StrokePrograms::StrokePrograms(const Scene& scene, SceneLook look, bool holes) : look_(look) {
    for (const std::vector<StrokeRange>* ranges : {&scene.pointRanges, &scene.lineRanges}) {
        for (const StrokeRange& range : *ranges) {
            const Variant variant = variantFor(scene.materials[range.material]);
            if (!programs_.contains(variant)) programs_.emplace(variant, makeVariant(variant, holes));
        }
    }
}

StrokePrograms::Chosen StrokePrograms::choose(const Material& material) const {
    const Variant variant = variantFor(material);
    return {programs_.at(variant).id(), variant.textured, variant.masked};
}

StrokeRenderer::StrokeRenderer(std::shared_ptr<const StrokePrograms> programs, const GpuScene& scene,
                               StrokeScene& strokes, const StrokePieces& pieces, const GpuOwners* owners)
    : scene_(scene),
      strokes_(strokes),
      pieces_(pieces),
      owners_(owners && owners->hasHoles() ? owners : nullptr),
      programs_(std::move(programs)),
      emptyVertexArray_(makeVertexArray()) {}

StrokePrograms::Variant StrokePrograms::variantFor(const Material& material) const {
    const bool color = look_.output == OutputKind::color;
    const bool masked = material.alphaCutoff >= 0;
    return {.lit = color && look_.style != Style::unlit && !material.unlit,
            .textured = material.texture >= 0 && (color || masked),
            .masked = masked,
            .singleCover = look_.output == OutputKind::coverage || material.blending != Blending::none};
}

GlProgram StrokePrograms::makeVariant(Variant variant, bool holes) const {
    std::vector<std::string> defines{outputDefine(look_.output),
                                     "PAIRS_PER_INSTANCE " + std::to_string(kPairsPerInstance) + "u",
                                     "MOST_EDGES " + std::to_string(kMostPieceEdges) + "u",
                                     "POINT_RADIUS_PX " + std::to_string(kPointSizePx / 2),
                                     "LINE_RADIUS_PX " + std::to_string(kLineWidthPx / 2)};
    const auto defineIf = [&](bool condition, const char* name) {
        if (condition) defines.emplace_back(name);
    };
    defineIf(holes, "HOLES");
    defineIf(variant.lit, "LIT");
    defineIf(variant.textured, "TEXTURED");
    defineIf(variant.masked, "MASKED");
    defineIf(variant.singleCover, "SINGLE_COVER");
    return makeProgram({{GL_VERTEX_SHADER, "stroke.vert"}, {GL_FRAGMENT_SHADER, "stroke.frag"}}, defines);
}

// What blends leaves no depth and no position, and to coverage all strokes are alike.
bool StrokeRenderer::isDrawn(const Material& material, bool blended) const {
    const bool blends = material.blending != Blending::none;
    if (programs_->look().output == OutputKind::coverage) return !blended;
    return blends == blended && (!blends || programs_->look().output == OutputKind::color);
}

void StrokeRenderer::recordSolid(const SceneView& view, const FramePass& pass) { record(view, pass, false); }

void StrokeRenderer::recordBlended(const SceneView& view, const FramePass& pass) { record(view, pass, true); }

void StrokeRenderer::record(const SceneView& view, const FramePass& pass, bool blended) {
    const std::vector<Material>& materials = scene_.scene->materials;
    Coverage& coverage = strokes_.coverage;
    enableClipPlanes(0);
    // Each sample of a pixel has its own distance from a stroke.
    glEnable(GL_SAMPLE_SHADING);
    glMinSampleShading(1);
    if (owners_) glBindTextureUnit(1, owners_->texture.id());
    // The pairs of a single part are still there when it is recorded a second time.
    const bool finds = !blended || coverage.parts().size() > 1;
    for (size_t i = 0; i < coverage.parts().size(); ++i) {
        const ScenePart& part = coverage.parts()[i];
        if (finds) coverage.findPairs(i, pieces_.found, view, glm::vec4(0));
        glBindVertexArray(emptyVertexArray_.id());
        glBindBuffer(GL_DRAW_INDIRECT_BUFFER, coverage.commands().id());
        bindStorage(0, part.chunk->positions);
        bindStorage(1, part.chunk->corners);
        bindStorage(2, pieces_.pieces);
        bindStorage(3, part.chunk->normals);
        bindStorage(4, part.chunk->uvs);
        bindStorage(5, coverage.commands());
        bindStorage(6, coverage.pairs());
        for (size_t r = 0; r < part.ranges.size(); ++r) {
            const Material& material = materials[part.ranges[r].material];
            if (!isDrawn(material, blended)) continue;
            if (blended) setBlending(material.blending);
            drawRange(part, r, view, pass);
        }
    }
    glDisable(GL_SAMPLE_SHADING);
    if (blended) {
        glDepthMask(GL_TRUE);
        setSceneState(programs_->look().output);
    }
}

void StrokeRenderer::drawRange(const ScenePart& part, size_t range, const SceneView& view,
                               const FramePass& pass) {
    const Material& material = scene_.scene->materials[part.ranges[range].material];
    const auto [program, textured, masked] = programs_->choose(material);
    glUseProgram(program);
    glProgramUniformMatrix3fv(program, 0, 1, GL_FALSE, &view.wallFromScene[0][0]);
    glProgramUniform3fv(program, 1, 1, &view.originFromEyeM[0]);
    glProgramUniform1f(program, 9, kNearFraction);
    glProgramUniform4fv(program, 10, 1, &material.baseColor[0]);
    if (masked) glProgramUniform1f(program, 11, material.alphaCutoff);
    glProgramUniform1ui(program, 13, static_cast<GLuint>(range));
    glProgramUniform2fv(program, 14, 1, &pass.shiftPx[0]);
    glProgramUniform2f(program, 15, static_cast<float>(pieces_.found.sizePx.x),
                       static_cast<float>(pieces_.found.sizePx.y));
    if (textured) {
        const auto texture = static_cast<size_t>(material.texture);
        glBindTextureUnit(0, scene_.textures[texture].id());
        glBindSampler(0, scene_.samplers[texture].id());
    }
    glDrawArraysIndirect(GL_TRIANGLES, reinterpret_cast<const void*>(kDrawCommandBytes * range));
}

}  // namespace curvewall
