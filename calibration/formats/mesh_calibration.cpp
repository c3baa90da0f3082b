#include "calibration/formats/mesh_calibration.h"

#include "calibration/errors.h"
#include "calibration/projections/grid_map.h"
#include "calibration/projections/lens_projection.h"
#include "calibration/projections/radial_lens.h"

#include <glm/common.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vector_relational.hpp>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

namespace curvewall {
namespace {

enum class GridFilling { cutFirstToLast, cutAcross, bilinear };

std::vector<WarpVertex> warpVertices(const MeshCalibration& mesh, glm::dvec2 sizePx,
                                     glm::dvec2 sourceSizePx) {
    std::vector<WarpVertex> vertices;
    for (const auto& vertex : mesh.vertices) {
        WarpVertex warped{.isValid = false};
        if (vertex) {
            warped = {vertex->screen * sizePx, vertex->source * sourceSizePx, vertex->intensity};
            // NaN is not within either.
            warped.isValid =
                glm::all(glm::lessThanEqual(glm::abs(warped.screenPx), glm::dvec2(kFarthestPx))) &&
                glm::all(glm::lessThanEqual(glm::abs(warped.sourcePx), glm::dvec2(kFarthestPx)));
        }
        vertices.push_back(warped);
    }
    return vertices;
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
    auto warp =
        std::make_shared<const WarpMesh>(warpVertices(mesh, sizePx, source.sizePx), mesh.cells, extentPx);
    if (!warp->hasArea())
        throw InputError(path, "", "a mesh that covers an area",
                         "no cell with valid vertices that has one on the screen and in the source");
    std::vector<float> intensity = linearIntensity(*warp, sizePx, intensityGamma);
    return {std::make_shared<WarpMeshProjection>(std::move(warp), source.projection), std::move(intensity)};
}

bool isMeshFile(const FileBytes&) { return false; }

MeshCalibration readMesh(const FileBytes& file, const FindFile&, Decisions&) {
    throw InputError(file.path, "", "a warp mesh", "a file that begins like none");
}

Display meshDisplay(const MeshCalibration& mesh, const FileBytes& file, const CalibrationRequest& request,
                    Decisions& decisions) {
    Display display{.name = file.stem(), .projectionType = "warp_mesh"};
    display.sizePx = decideSize(request, mesh.sizePx, mesh.aspect, decisions);
    const double gamma = decideIntensityGamma(mesh, decisions);
    SourcePicture source = request.source.value_or(SourcePicture{});
    if (mesh.frustum)
        source = {display.sizePx, std::make_shared<FrustumProjection>(*mesh.frustum, display.sizePx)};
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
                              {"bilinear", GridFilling::bilinear}},
                             guess == CellCut::across ? GridFilling::cutAcross : GridFilling::cutFirstToLast,
                             evidence)) {
        case GridFilling::cutFirstToLast:
            return trianglesOfGrid(vertices);
        case GridFilling::cutAcross:
            return trianglesOfGrid(vertices, CellCut::across);
        default:
            return quadrilateralsOfGrid(vertices);
    }
}

double decideIntensityGamma(const MeshCalibration& mesh, Decisions& decisions) {
    if (std::ranges::all_of(mesh.vertices, [](const auto& v) { return !v || v->intensity == 1; })) return 1;
    return decisions.number("intensity_gamma", {0, 10, true}, 2.2,
                            "programs multiply encoded colours by the intensity");
}

}  // namespace curvewall
