#include "calibration/formats/sgct_correction.h"

#include "calibration/errors.h"
#include "calibration/files/map_file.h"
#include "calibration/files/pfm_file.h"
#include "calibration/formats/blend_files.h"
#include "calibration/formats/map_calibration.h"
#include "calibration/formats/map_decisions.h"
#include "calibration/formats/mesh_file.h"
#include "calibration/projections/picture_views.h"

#include <fmt/format.h>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <utility>

namespace curvewall {
namespace {

constexpr double kSameDeg = 0.01;  // of what a mesh and the configuration say of one frustum

// SGCT takes the frustum from these files and forgets the configuration's.
bool bringsItsFrustum(const FileBytes& file) {
    constexpr std::array<const char*, 4> kExtensions{".sgc", ".ol", ".skyskan", ".txt"};
    return std::ranges::find(kExtensions, file.extension()) != kExtensions.end();
}

SgctView viewOf(const Frustum& frustum) {
    return {glm::degrees(frustum.leftRad), glm::degrees(frustum.rightRad), glm::degrees(frustum.downRad),
            glm::degrees(frustum.upRad), rotationFromOrientation(frustum.orientation)};
}

double angleBetweenDeg(const glm::dmat3& a, const glm::dmat3& b) {
    const glm::dmat3 turn = glm::transpose(a) * b;
    const double cosine = (turn[0][0] + turn[1][1] + turn[2][2] - 1) / 2;
    return glm::degrees(std::acos(std::clamp(cosine, -1.0, 1.0)));
}

void warnOfOtherFrustum(const SgctContext& context, const FileBytes& file, const Frustum& frustum,
                        Decisions& decisions) {
    if (!context.viewport.hasProjection) return;
    const auto configured = sgctView(context.viewport.projection, context.eye.eyeM);
    if (!configured) return;
    const SgctView taken = viewOf(frustum);
    std::string differences;
    const auto compare = [&](const char* side, double takenDeg, double configuredDeg) {
        if (std::abs(takenDeg - configuredDeg) > kSameDeg)
            differences +=
                fmt::format("{} {:.3f} instead of {:.3f} degrees, ", side, takenDeg, configuredDeg);
    };
    compare("left", taken.leftDeg, configured->leftDeg);
    compare("right", taken.rightDeg, configured->rightDeg);
    compare("down", taken.downDeg, configured->downDeg);
    compare("up", taken.upDeg, configured->upDeg);
    if (const double turnDeg = angleBetweenDeg(taken.rotation, configured->rotation); turnDeg > kSameDeg)
        differences += fmt::format("turned by {:.3f} degrees, ", turnDeg);
    if (!differences.empty())
        decisions.warn(fmt::format("{}.projection: {} is made for another frustum, which is taken: {}",
                                   context.viewport.place, file.name(),
                                   differences.substr(0, differences.size() - 2)));
}

ProjectionPtr mirroredOf(const SgctContext& context, ProjectionPtr picture) {
    if (!context.window.isMirroredX && !context.window.isMirroredY) return picture;
    return std::make_shared<MirroredProjection>(std::move(picture), context.sizePx,
                                                context.window.isMirroredX, context.window.isMirroredY);
}

// SGCT draws the mesh in the window's own shape, whatever shape the mesh is made for.
void fitWidth(MeshCalibration& mesh, double meshAspect, double screenAspect) {
    for (auto& vertex : mesh.vertices)
        if (vertex) vertex->screen.x = 0.5 + (vertex->screen.x - 0.5) * meshAspect / screenAspect;
}

void warnOfOtherShape(const SgctContext& context, const FileBytes& file, double meshAspect,
                      Decisions& decisions) {
    constexpr double kSameShape = 0.01;
    if (std::abs(meshAspect / context.aspect - 1) > kSameShape)
        decisions.warn(
            fmt::format("{}.mesh: {} is made for a screen {:.4f} times as wide as high, the "
                        "viewport is {:.4f} times",
                        context.viewport.place, file.name(), meshAspect, context.aspect));
}

// What stays in memory of a vertex and of a cell, in the budget's texels.
constexpr int kTexelsOfPart = 8;

// The mesh on the viewport, whose memory and intensity factors are charged first.
MeshDisplay chargedMesh(const SgctContext& context, const MeshCalibration& mesh, const SourcePicture& source,
                        const std::string& path, Decisions& decisions) {
    const std::string place = context.viewport.place + ".mesh";
    context.budget.take({static_cast<int>(mesh.vertices.size() + mesh.cells.size()), kTexelsOfPart}, place);
    const bool dims =
        std::ranges::any_of(mesh.vertices, [](const auto& v) { return v && v->intensity != 1; });
    if (dims) context.budget.take(context.sizePx, place);
    const double gamma = decideIntensityGamma(mesh, decisions);
    return meshOnDisplay(mesh, context.sizePx, source, gamma, path);
}

SgctShown bentByMesh(const SgctContext& context, const FileBytes& file, Decisions& decisions) {
    if (!isMeshFile(file))
        throw InputError(file.path, "", "a correction mesh that SGCT knows", "a file that begins like none");
    MeshCalibration mesh = readMesh(file, {}, decisions);
    SgctScreen screen{.sizePx = context.sizePx};
    if (mesh.aspect && mesh.bendsFisheye) {
        warnOfOtherShape(context, file, *mesh.aspect, decisions);
        fitWidth(mesh, *mesh.aspect, context.aspect);
        screen.pictureAspect = 1;
    }
    SourcePicture source{context.sizePx, nullptr};
    if (mesh.frustum && bringsItsFrustum(file)) {
        warnOfOtherFrustum(context, file, *mesh.frustum, decisions);
        source.projection = std::make_shared<FrustumProjection>(*mesh.frustum, context.sizePx);
    } else {
        source.projection =
            sgctPicture(context.viewport.projection, screen, context.eye, decisions).projection;
    }
    source.projection = mirroredOf(context, std::move(source.projection));
    return {chargedMesh(context, mesh, source, file.path, decisions), "warp_mesh"};
}

enum class StereoHalf { none, left, right };

NumberMap columnsOf(const NumberMap& map, int begin, int count) {
    NumberMap part{{count, map.sizePx.y}, map.channels, map.isInteger, {}};
    const auto rowLength = static_cast<ptrdiff_t>(count) * map.channels;
    for (int y = 0; y < map.sizePx.y; ++y)
        part.values.insert(part.values.end(), map.at(begin, y), map.at(begin, y) + rowLength);
    return part;
}

// Forward maps for both eyes lie side by side.
NumberMap decideHalf(NumberMap map, bool isForward, const FileBytes& file, Decisions& decisions) {
    const std::string evidence =
        isForward
            ? fmt::format("SGCT draws the left half of the {} columns, whichever eye it is for", map.sizePx.x)
            : fmt::format("SGCT takes all {} columns for one map", map.sizePx.x);
    const auto half = decisions.choose<StereoHalf>(
        "stereo_half", {{"none", StereoHalf::none}, {"left", StereoHalf::left}, {"right", StereoHalf::right}},
        isForward ? StereoHalf::left : StereoHalf::none, evidence);
    if (half == StereoHalf::none) return map;
    const int columns = map.sizePx.x / 2;
    if (columns < 2 || map.sizePx.x % 2 != 0)
        throw InputError(file.path, "", "maps of two eyes side by side, which have an even number of columns",
                         fmt::format("{} columns", map.sizePx.x));
    return columnsOf(map, half == StereoHalf::left ? 0 : columns, columns);
}

// Whatever PFM says of its rows, SGCT takes the first one of the file for the top, and values grow upwards.
// Whether that agrees with the numbers is told beside it.
MapMeaning decideMapMeaning(const SgctContext& context, const FileBytes& file, MapDirection direction,
                            const NumberMap& map, Decisions& decisions) {
    const bool isForward = direction == MapDirection::forward, hasPfmRows = isPfm(file.bytes);
    const MapSurvey s = surveyMap(map, hasPfmRows);
    MapMeaning meaning{.direction = direction};
    meaning.isOffset = decisions.choose<bool>(
        "map_values", {{"absolute", false}, {"offset", true}}, false,
        fmt::format("SGCT reads positions; the numbers are {:.3f} to {:.3f} and {:.3f} to {:.3f}{}", s.low.x,
                    s.high.x, s.low.y, s.high.y, looksLikeOffsets(s) ? ", as offsets would be" : ""));
    const std::string rows = fmt::format(
        "the second number is {:.3f} on the average of the file's first rows and {:.3f} of the last",
        s.firstRowsY, s.lastRowsY);
    meaning.yUp = decisions.choose<bool>(isForward ? "screen_y" : "source_v", {{"up", true}, {"down", false}},
                                         true, "SGCT counts upwards, as OpenGL does; " + rows);
    const bool isTopFirst =
        decisions.choose<bool>("row_order", {{"bottom_first", false}, {"top_first", true}}, true,
                               "SGCT takes the first row for the top, whatever PFM says; " + rows);
    meaning.bottomRowFirst = hasPfmRows == isTopFirst;
    constexpr double kSays = 0.05;
    const double falls = (meaning.yUp == isTopFirst ? 1 : -1) * (s.firstRowsY - s.lastRowsY);
    if (!meaning.isOffset && falls < -kSays)
        decisions.warn(fmt::format("{}.mesh: {} shows its picture upside down: {}", context.viewport.place,
                                   file.name(), rows));
    const std::string nodes = fmt::format("{} x {} nodes for {} x {} pixels", map.sizePx.x, map.sizePx.y,
                                          context.sizePx.x, context.sizePx.y);
    meaning.alignment = decisions.choose<Alignment>(
        "node_alignment", {{"centers", Alignment::centers}, {"corners", Alignment::corners}},
        isForward ? Alignment::centers : Alignment::corners,
        (isForward ? "SGCT puts the nodes at the centres of their cells: "
                   : "SGCT spreads the nodes to the borders of the screen: ") +
            nodes);
    if (isForward)
        meaning.cells = decideCells(map.sizePx, CellCut::alternating,
                                    "SGCT draws a strip of triangles that runs to and fro", decisions);
    else
        decisions.choose<bool>("interpolation", {{"bilinear", true}}, true,
                               "between nodes nothing was measured: " + nodes);
    return meaning;
}

SgctShown bentByMap(const SgctContext& context, const FileBytes& file, Decisions& decisions) {
    const auto* planar = std::get_if<SgctPlanar>(&context.viewport.projection);
    const bool isTextureMapped = planar && planar->isTextureMapped;
    const SgctPicture picture =
        sgctPicture(context.viewport.projection, {context.sizePx}, context.eye, decisions);
    const SourcePicture source{context.sizePx, mirroredOf(context, picture.projection)};
    const auto direction = decisions.choose<MapDirection>(
        "map_direction", {{"forward", MapDirection::forward}, {"inverse", MapDirection::inverse}},
        isTextureMapped ? MapDirection::inverse : MapDirection::forward,
        isTextureMapped ? "SGCT reads the PFM of a TextureMappedProjection so"
                        : "SGCT reads the PFM of any projection but a TextureMappedProjection so");
    const bool isForward = direction == MapDirection::forward;
    const std::string place = context.viewport.place + ".mesh";
    NumberMap map = readNumberMap(file);
    context.budget.take(map.sizePx, place);
    map = decideHalf(std::move(map), isForward, file, decisions);
    const MapMeaning meaning = decideMapMeaning(context, file, direction, map, decisions);
    if (isForward)
        return {chargedMesh(context, meshOfMap(map, meaning, file.path), source, file.path, decisions),
                "warp_mesh"};
    return {{projectionOfMap(map, meaning, context.sizePx, source, file.path), {}}, "camera_texture"};
}

// All four meshes as one, which takes from a row of four pictures. Where they overlap SGCT shows what it drew
// last, and a mesh of ours what it finds first.
SgctShown mirrorShown(const SgctContext& context, const SgctMirror& mirror, Decisions& decisions) {
    constexpr double kFacePx = 1024;
    const std::vector<SgctFace> faces = sgctMirrorFaces(mirror, glm::dvec2(kFacePx));
    std::vector<ProjectionPtr> pictures(faces.size());
    std::ranges::transform(faces, pictures.begin(), &SgctFace::projection);
    const auto atlas = std::make_shared<PictureAtlas>(std::move(pictures), glm::dvec2(kFacePx));
    const std::array<std::pair<const char*, std::string>, 4> files{{{"bottom", mirror.bottomMesh},
                                                                    {"left", mirror.leftMesh},
                                                                    {"right", mirror.rightMesh},
                                                                    {"top", mirror.topMesh}}};
    MeshCalibration all;
    for (size_t i = files.size(); i-- > 0;) {
        const FileBytes file =
            context.find(std::string("projection.geometry.") + files[i].first, files[i].second);
        if (!isMeshFile(file))
            throw InputError(file.path, "", "a mesh in OBJ", "a file that begins like none");
        MeshCalibration mesh = readMesh(file, {}, decisions);
        // SGCT draws these in units of half the height.
        fitWidth(mesh, 1, context.aspect);
        const auto first = static_cast<uint32_t>(all.vertices.size());
        for (auto& vertex : mesh.vertices) {
            if (vertex) vertex->source = (atlas->placePx(i) + vertex->source * kFacePx) / atlas->sizePx();
            all.vertices.push_back(vertex);
        }
        for (WarpCell cell : mesh.cells) {
            for (uint32_t& vertex : cell.vertices) vertex += first;
            all.cells.push_back(cell);
        }
    }
    const SourcePicture source{atlas->sizePx(), atlas};
    return {chargedMesh(context, all, source, context.viewport.place, decisions), "warp_mesh"};
}

void multiply(std::vector<glm::vec3>& factors, const std::vector<glm::vec3>& others) {
    if (factors.empty())
        factors = others;
    else
        std::ranges::transform(factors, others, factors.begin(), std::multiplies<>());
}

// The window's mirror turns a mask over where it is.
void mirror(std::vector<glm::vec3>& picture, const SgctContext& context) {
    const auto width = static_cast<ptrdiff_t>(context.sizePx.x);
    const auto rowAt = [&](int y) { return picture.begin() + y * width; };
    if (context.window.isMirroredX)
        for (int y = 0; y < context.sizePx.y; ++y) std::reverse(rowAt(y), rowAt(y) + width);
    if (context.window.isMirroredY)
        for (int y = 0; y < context.sizePx.y / 2; ++y)
            std::swap_ranges(rowAt(y), rowAt(y) + width, rowAt(context.sizePx.y - 1 - y));
}

int64_t texels(glm::ivec2 sizePx) { return int64_t{sizePx.x} * sizePx.y; }

// A picture of the size of its display, as most are, costs no more than the mask that it becomes.
std::vector<glm::vec3> readMask(const SgctContext& context, const char* key, const std::string& name,
                                Decisions& decisions) {
    const double gamma =
        decisions.number("blend_gamma", {0.1, 10}, 2.2, "SGCT multiplies encoded colours by the mask");
    const std::string place = context.viewport.place + "." + key;
    context.budget.take(context.sizePx, place);
    const FileBytes file = context.find(key, name);
    const NumberMap picture = readNumberMap(file);
    if (texels(picture.sizePx) > texels(context.sizePx)) context.budget.take(picture.sizePx, place);
    std::vector<glm::vec3> mask = linearPicture(picture, file.path, context.sizePx, gamma, place, decisions);
    mirror(mask, context);
    return mask;
}

}  // namespace

SgctShown sgctShown(const SgctContext& context, Decisions& decisions) {
    const SgctViewport& viewport = context.viewport;
    if (const auto* spherical = std::get_if<SgctMirror>(&viewport.projection))
        return mirrorShown(context, *spherical, decisions);
    if (!viewport.mesh.empty()) {
        const FileBytes file = context.find("mesh", viewport.mesh);
        return file.extension() == ".pfm" ? bentByMap(context, file, decisions)
                                          : bentByMesh(context, file, decisions);
    }
    SgctPicture picture = sgctPicture(viewport.projection, {context.sizePx}, context.eye, decisions);
    return {{mirroredOf(context, std::move(picture.projection)), {}}, picture.type};
}

BlendMaps sgctBlend(const SgctContext& context, bool isXml, const std::vector<float>& intensity,
                    Decisions& decisions) {
    enum class BlackLevel { multiply, add };
    const SgctViewport& viewport = context.viewport;
    BlendMaps maps;
    multiplyPicture(maps, intensity);
    if (!viewport.blendMask.empty())
        multiply(maps.alpha, readMask(context, "blendmask", viewport.blendMask, decisions));
    if (viewport.blackLevelMask.empty()) return maps;
    std::vector<glm::vec3> level = readMask(context, "blacklevelmask", viewport.blackLevelMask, decisions);
    const auto meaning =
        decisions.choose("black_level", {{"multiply", BlackLevel::multiply}, {"add", BlackLevel::add}},
                         isXml ? BlackLevel::add : BlackLevel::multiply,
                         isXml ? "SGCT of the XML's time added the mask to what it left of the picture"
                               : "SGCT since 2024 multiplies the picture by the mask; older ones added it");
    if (meaning == BlackLevel::add)
        maps.beta = std::move(level);
    else
        multiply(maps.alpha, level);
    return maps;
}

}  // namespace curvewall
