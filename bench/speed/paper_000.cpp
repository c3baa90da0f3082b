// Tables 2 and 3 of Gascuel et al. (2008) with our scenes.

#include "bench/request.h"
#include "bench/speed/csv.h"
#include "bench/speed/parts.h"
#include "bench/speed/rounds.h"
#include "bench/speed/walls.h"
#include "calibration/projections/lens_projection.h"
#include "calibration/projections/planar.h"
#include "calibration/projections/radial_lens.h"
#include "renderer/names.h"
#include "renderer/scene/city.h"
#include "renderer/scene/load_scene.h"
#include "tests/support/test_projections.h"

#include <algorithm>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

namespace curvewall {
namespace {

constexpr uint32_t kFacadeTriangles = 1'900, kFacadeOfTable3 = 2'800;

// One picture, or the several that together show what it shows.
struct View {
    std::string name;
    std::vector<WallPtr> walls;
    Method method = Method::boundedRaycast;
    BoundingShape bounds = BoundingShape::triangle;
};

WallPtr lensWall(RadialModel model, double yawRad, int sizePx) {
    const glm::ivec2 size(sizePx);
    const RadialFunction function{model, {}};
    return std::make_shared<const Wall>(
        wallOf(std::make_shared<LensProjection>(circularLens(function, std::numbers::pi, size),
                                                Orientation{.yawRad = yawRad}),
               size));
}

// A face of a cube; those of half a cube end at the horizon of the one ahead.
WallPtr faceWall(glm::dvec3 ahead, glm::dvec3 up, double from, glm::ivec2 sizePx) {
    const glm::dvec3 right = glm::cross(ahead, up);
    const PlanarScreen screen{ahead - right + from * up, ahead + right + from * up, ahead - right + up};
    return std::make_shared<const Wall>(
        wallOf(std::make_shared<PlanarProjection>(screen, glm::dvec3(0), sizePx), sizePx));
}

View cubeOf(int sizePx) {
    View view{"6 faces of a cube", {}, Method::piecewise};
    for (const glm::dvec3 ahead : {glm::dvec3(0, 0, -1), {1, 0, 0}, {0, 0, 1}, {-1, 0, 0}})
        view.walls.push_back(faceWall(ahead, {0, 1, 0}, -1, glm::ivec2(sizePx)));
    for (const double y : {1.0, -1.0})
        view.walls.push_back(faceWall({0, y, 0}, {0, 0, y}, -1, glm::ivec2(sizePx)));
    return view;
}

// The face ahead and the halves of the four around it that lie before the eye.
View hemicubeOf(int sizePx) {
    View view{"5 faces of a hemicube", {}, Method::piecewise};
    view.walls.push_back(faceWall({0, 0, -1}, {0, 1, 0}, -1, glm::ivec2(sizePx)));
    for (const glm::dvec3 side : {glm::dvec3(1, 0, 0), {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}})
        view.walls.push_back(faceWall(side, {0, 0, -1}, 0, {sizePx, sizePx / 2}));
    return view;
}

View lenses(const std::string& name, RadialModel model, int count, int sizePx, BoundingShape bounds) {
    View view{std::to_string(count) + " " + name + ", " + std::string(nameOf(bounds)) + " bounds",
              {},
              Method::boundedRaycast,
              bounds};
    for (int i = 0; i < count; ++i) view.walls.push_back(lensWall(model, std::numbers::pi * i, sizePx));
    return view;
}

std::vector<View> viewsOf(int sizePx) {
    std::vector<View> views{cubeOf(sizePx), hemicubeOf(sizePx)};
    for (const BoundingShape bounds : {BoundingShape::triangle, BoundingShape::quad}) {
        views.push_back(lenses("paraboloids", RadialModel::stereographic, 2, sizePx, bounds));
        views.push_back(lenses("paraboloid", RadialModel::stereographic, 1, sizePx, bounds));
        views.push_back(lenses("sphere map", RadialModel::orthographic, 1, sizePx, bounds));
        views.push_back(lenses("Lambert", RadialModel::equisolid, 1, sizePx, bounds));
    }
    View pieces = lenses("paraboloid", RadialModel::stereographic, 1, sizePx, BoundingShape::triangle);
    pieces.name = "1 paraboloid, pieces of 0.25 px";
    pieces.method = Method::piecewise;
    views.push_back(std::move(pieces));
    return views;
}

RenderRequest requestOf(const View& view, const WallPtr& wall, const ScenePtr& scene, OutputKind output,
                        int frames) {
    RenderRequest request = requestFor(wall, scene, frames);
    request.method = view.method;
    request.bounds = view.bounds;
    request.output = output;
    return request;
}

// What a view's pictures take together.
double totalMs(const std::vector<Rounds>& rounds) {
    double sum = 0;
    for (const Rounds& each : rounds) sum += medianRound(each).frameMsMedian;
    return sum;
}

void measureTable2(const SpeedOptions& options) {
    const auto facade = std::make_shared<const Scene>(makeCity(kFacadeTriangles));
    for (const int sizePx : {512, 16})
        for (const View& view : viewsOf(sizePx)) {
            Renderer renderer;
            for (const OutputKind output : {OutputKind::color, OutputKind::depth, OutputKind::coverage}) {
                std::vector<RenderRequest> requests;
                for (const WallPtr& wall : view.walls)
                    requests.push_back(requestOf(view, wall, facade, output, options.frames));
                print({"paper-000-table-2", std::to_string(sizePx) + " px, " + view.name},
                      std::string(nameOf(output)) + "_ms",
                      totalMs(renderInTurns(renderer, requests, options.rounds)));
            }
        }
}

void measureLine(const std::string& name, const View& view, const ScenePtr& scene,
                 const SpeedOptions& options) {
    Renderer renderer;
    std::vector<RenderRequest> requests{
        requestOf(cubeOf(512), cubeOf(512).walls.front(), scene, OutputKind::color, options.frames),
        requestOf(view, view.walls.front(), scene, OutputKind::color, options.frames)};
    const std::vector<Rounds> rounds = renderInTurns(renderer, requests, options.rounds);
    RenderRequest counting = requests.back();
    counting.frames = 1;
    counting.measuresError = true;
    const RenderStats counted = renderer.render(counting).stats;
    const Row row{"paper-000-table-3", name};
    print(row, "triangles", static_cast<double>(scene->triangles.size()));
    print(row, "covered_kpx", 1e-3 * static_cast<double>(counted.coveredFragments));
    print(row, "rendered_kpx", 1e-3 * static_cast<double>(counted.renderedFragments));
    print(row, "overdraw", counted.overdraw());
    print(row, "max_error_px", counted.geometricError.maxPx);
    print(row, "frame_ms", medianRound(rounds[1]).frameMsMedian);
    print(row, "times_gl", medianRatio(rounds[1], rounds[0]));
}

void measureTable3(const SpeedOptions& options) {
    const auto facade = std::make_shared<const Scene>(makeCity(kFacadeOfTable3));
    constexpr auto kTriangle = BoundingShape::triangle, kQuad = BoundingShape::quad;
    const auto lens = [](RadialModel model, BoundingShape bounds) {
        return lenses("lens", model, 1, 512, bounds);
    };
    measureLine("ST", lens(RadialModel::orthographic, kTriangle), facade, options);
    measureLine("PT", lens(RadialModel::stereographic, kTriangle), facade, options);
    measureLine("SQ", lens(RadialModel::orthographic, kQuad), facade, options);
    measureLine("PQ", lens(RadialModel::stereographic, kQuad), facade, options);
    // The paper bounds its two fisheyes by the strategy of section 4.6 only.
    constexpr auto kGeneric = BoundingShape::genericQuad;
    measureLine("Lens1", lens(RadialModel::equisolid, kGeneric), facade, options);
    measureLine("Lens2", lens(RadialModel::equidistant, kGeneric), facade, options);
    measureLine("Lens1 Q", lens(RadialModel::equisolid, kQuad), facade, options);
    measureLine("Lens2 Q", lens(RadialModel::equidistant, kQuad), facade, options);
    measureLine("Lens1 T", lens(RadialModel::equisolid, kTriangle), facade, options);
    measureLine("Lens2 T", lens(RadialModel::equidistant, kTriangle), facade, options);
    for (const uint32_t triangles : {1'000u, 2'800u, 4'900u})
        measureLine("PQ, " + std::to_string(triangles), lens(RadialModel::stereographic, kQuad),
                    std::make_shared<const Scene>(makeCity(triangles)), options);
    for (const std::string& scene : options.scenes)
        measureLine("PQ, " + scene, lens(RadialModel::stereographic, kQuad),
                    std::make_shared<const Scene>(loadScene(scene)), options);
}

}  // namespace

void measurePaper000(const SpeedOptions& options) {
    measureTable2(options);
    measureTable3(options);
}

}  // namespace curvewall
