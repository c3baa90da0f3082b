#include "calibration/formats/mesh_calibration.h"

#include "calibration/errors.h"
#include "calibration/formats/display_names.h"
#include "calibration/projections/grid_map.h"
#include "calibration/projections/lens_projection.h"
#include "calibration/projections/radial_lens.h"

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vector_relational.hpp>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

namespace curvewall {
namespace {

// Their factors take sixteen bytes a pixel.
constexpr int64_t kMostDimmedPixels = int64_t{1} << 26;

enum class GridFilling { cutFirstToLast, cutAcross, cutAlternating, bilinear };

constexpr double kMostIntensity = 1000;  // to the power of any gamma it still is a float

GridFilling fillingOf(CellCut cut) {
    switch (cut) {
        case CellCut::firstToLast:
            return GridFilling::cutFirstToLast;
        case CellCut::across:
            return GridFilling::cutAcross;
        case CellCut::alternating:
            break;
    }
    return GridFilling::cutAlternating;
}

std::vector<WarpVertex> warpVertices(const MeshCalibration& mesh, glm::dvec2 sizePx,
                                     glm::dvec2 sourceSizePx) {
    std::vector<WarpVertex> vertices;
    for (const auto& vertex : mesh.vertices) {
        WarpVertex warped{.isValid = false};
        if (vertex) {
            warped = {vertex->screen * sizePx, vertex->source * sourceSizePx, vertex->intensity};
            // NaN is not within either.
            warped.isValid =
                warped.intensity <= kMostIntensity &&
                glm::all(glm::lessThanEqual(glm::abs(warped.screenPx), glm::dvec2(kFarthestPx))) &&
                glm::all(glm::lessThanEqual(glm::abs(warped.sourcePx), glm::dvec2(kFarthestPx)));
        }
        vertices.push_back(warped);
    }
    return vertices;
}

SourcePicture sourceOf(const MeshCalibration& mesh, const CalibrationRequest& request, glm::ivec2 sizePx,
                       Decisions& decisions) {
    if (mesh.frustum && request.source)
        decisions.warn("source: the file tells itself what its picture shows, and that counts");
    if (mesh.frustum) return {sizePx, std::make_shared<FrustumProjection>(*mesh.frustum, sizePx)};
    if (request.source) return *request.source;
    return decideSource(mesh.bendsFisheye,
                        mesh.bendsFisheye ? "meshes of this format are made for fisheye pictures"
                                          : "nothing in the file tells what its source picture shows",
                        sizePx, decisions);
}

// A position is looked for in every cell whose box it lies in. Real meshes fold a few times at most; without
// a limit a few kilobytes of random vertices would take hours.
void requireFewLayers(const std::vector<WarpVertex>& vertices, const std::vector<WarpCell>& cells,
                      glm::dvec2 WarpVertex::*place, glm::dvec2 sizePx, const char* what,
                      const std::string& path) {
    constexpr double kMostLayers = 100;
    double area = 0;
    for (const WarpCell& cell : cells) {
        glm::dvec2 low = sizePx, high(0);
        bool isValid = true;
        for (size_t i = 0; i < (cell.shape == CellShape::triangle ? 3U : 4U); ++i) {
            const WarpVertex& vertex = vertices[cell.vertices[i]];
            isValid = isValid && vertex.isValid;
            low = glm::min(low, vertex.*place);
            high = glm::max(high, vertex.*place);
        }
        const glm::dvec2 inside = glm::min(high, sizePx) - glm::max(low, glm::dvec2(0));
        if (isValid && inside.x > 0 && inside.y > 0) area += inside.x * inside.y;
    }
    const double layers = area / (sizePx.x * sizePx.y);
    if (layers > kMostLayers)
        throw InputError(path, "",
                         fmt::format("cells that cover {} at most {} times over", what, kMostLayers),
                         fmt::format("{:.0f} times", layers));
}

bool dimsNothing(const MeshCalibration& mesh) {
    return std::ranges::all_of(mesh.vertices, [](const auto& v) { return !v || v->intensity == 1; });
}

}  // namespace

bool isWithinPicture(glm::dvec2 fraction) {
    return glm::all(glm::greaterThanEqual(fraction, glm::dvec2(0))) &&
           glm::all(glm::lessThanEqual(fraction, glm::dvec2(1)));
}

MeshDisplay meshOnDisplay(const MeshCalibration& mesh, glm::ivec2 sizePx, const SourcePicture& source,
                          double intensityGamma, const std::string& path) {
    const double extentPx = std::max(
        {static_cast<double>(sizePx.x), static_cast<double>(sizePx.y), source.sizePx.x, source.sizePx.y});
    std::vector<WarpVertex> vertices = warpVertices(mesh, sizePx, source.sizePx);
    requireFewLayers(vertices, mesh.cells, &WarpVertex::screenPx, sizePx, "the screen", path);
    requireFewLayers(vertices, mesh.cells, &WarpVertex::sourcePx, source.sizePx, "the source", path);
    auto warp = std::make_shared<const WarpMesh>(std::move(vertices), mesh.cells, extentPx);
    if (!warp->hasArea())
        throw InputError(path, "", "a mesh that covers an area",
                         "no cell with valid vertices that has one on the screen and in the source");
    std::vector<float> intensity;
    const int64_t pixels = int64_t{sizePx.x} * sizePx.y;
    if (!dimsNothing(mesh) && pixels > kMostDimmedPixels)
        throw InputError(
            path, "",
            fmt::format("a display of at most {} pixels for a mesh with intensities", kMostDimmedPixels),
            std::to_string(pixels));
    if (!dimsNothing(mesh)) intensity = linearIntensity(*warp, sizePx, intensityGamma);
    return {std::make_shared<WarpMeshProjection>(std::move(warp), source.projection), std::move(intensity)};
}

std::optional<MeshVertex> vertexIfValid(const MeshVertex& vertex) {
    const bool isFinite = std::isfinite(vertex.screen.x) && std::isfinite(vertex.screen.y) &&
                          std::isfinite(vertex.source.x) && std::isfinite(vertex.source.y) &&
                          std::isfinite(vertex.intensity);
    if (!isFinite || vertex.intensity < 0) return std::nullopt;
    return vertex;
}

void requireFrustum(const Frustum& frustum, const FileBytes& file) {
    try {
        const FrustumProjection projection(frustum, {1, 1});
    } catch (const UsageError& error) {
        throw InputError(file.path, "frustum", "a picture with an area", error.what());
    }
}

SourcePicture decideSource(bool isFisheye, const std::string& evidence, glm::ivec2 displayPx,
                           Decisions& decisions) {
    isFisheye = decisions.choose("source", {{"fisheye", true}, {"perspective", false}}, isFisheye, evidence);
    const Range fov = isFisheye ? Range{0, 360, true} : Range{0, 180, true, true};
    const double fovRad =
        glm::radians(decisions.number("source_fov_deg", fov, isFisheye ? 180 : 90,
                                      isFisheye ? "fisheye pictures show a hemisphere as a rule"
                                                : "no more than a convention, horizontally"));
    const auto angleRad = [&](const char* key, double guessDeg, const char* why) {
        return glm::radians(decisions.number(key, {-360, 360}, guessDeg, why));
    };
    const Orientation orientation{
        angleRad("source_yaw_deg", 0, "the picture is taken to look ahead"),
        isFisheye ? angleRad("source_pitch_deg", 90,
                             "the centre of a fulldome master is the zenith, its bottom edge the front")
                  : angleRad("source_pitch_deg", 0, "the picture is taken to look ahead"),
        angleRad("source_roll_deg", 0, "the picture is taken to be upright")};
    const glm::dvec2 sizePx = displayPx;
    if (isFisheye) {
        const int sidePx = std::max(displayPx.x, displayPx.y);
        LensPtr lens = circularLens({}, fovRad, glm::ivec2(sidePx));
        return {glm::dvec2(sidePx), std::make_shared<LensProjection>(std::move(lens), orientation)};
    }
    const double upRad = std::atan(std::tan(fovRad / 2) * sizePx.y / sizePx.x);
    const Frustum frustum{-fovRad / 2, fovRad / 2, -upRad, upRad, orientation};
    return {sizePx, std::make_shared<FrustumProjection>(frustum, sizePx)};
}

Display meshDisplay(const MeshCalibration& mesh, const FileBytes& file, const CalibrationRequest& request,
                    Decisions& decisions) {
    Display display{.name = safeDisplayName(file.stem()), .projectionType = "warp_mesh"};
    display.sizePx = decideSize(request, mesh.sizePx, mesh.aspect, decisions);
    const double gamma = decideIntensityGamma(mesh, decisions);
    const SourcePicture source = sourceOf(mesh, request, display.sizePx, decisions);
    MeshDisplay onDisplay = meshOnDisplay(mesh, display.sizePx, source, gamma, file.path);
    display.projection = std::move(onDisplay.projection);
    BlendMaps blend;
    multiplyPicture(blend, onDisplay.intensity);
    if (!blend.empty()) display.blend = std::make_shared<const BlendMaps>(std::move(blend));
    listDecisions(decisions, display);
    return display;
}

std::vector<WarpCell> decideCells(glm::ivec2 vertices, CellCut guess, const std::string& evidence,
                                  Decisions& decisions) {
    switch (decisions.choose("interpolation",
                             {{"triangles", GridFilling::cutFirstToLast},
                              {"triangles_across", GridFilling::cutAcross},
                              {"triangles_alternating", GridFilling::cutAlternating},
                              {"bilinear", GridFilling::bilinear}},
                             fillingOf(guess), evidence)) {
        case GridFilling::cutFirstToLast:
            return trianglesOfGrid(vertices);
        case GridFilling::cutAcross:
            return trianglesOfGrid(vertices, CellCut::across);
        case GridFilling::cutAlternating:
            return trianglesOfGrid(vertices, CellCut::alternating);
        case GridFilling::bilinear:
            break;
    }
    return quadrilateralsOfGrid(vertices);
}

double decideIntensityGamma(const MeshCalibration& mesh, Decisions& decisions) {
    if (dimsNothing(mesh)) return 1;
    return decisions.number(
        "intensity_gamma", {0, 10, true}, mesh.intensityGamma.value_or(2.2),
        mesh.intensityGamma ? "the file names it" : "programs multiply encoded colours by the intensity");
}

}  // namespace curvewall
