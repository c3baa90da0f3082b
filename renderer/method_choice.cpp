#include "renderer/method_choice.h"

#include "calibration/errors.h"
#include "calibration/pieces/piece_fit.h"
#include "renderer/cube_source.h"
#include "renderer/names.h"
#include "renderer/planar_source.h"
#include "renderer/request_limits.h"
#include "renderer/round_lens.h"
#include "renderer/scene_facts.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <string_view>

namespace curvewall {
namespace {

struct Facts {
    const RenderRequest& request;
    const Display& display;
    DisplayFacts shown;
    SceneFacts scene;

    double fragments(double px) const { return scene.fragmentsAPixel * px; }
};

// Fitted to what `curvewall_speed methods` measured (docs/auto.md).
struct Costs {
    double frameMs, seenNs, drawnNs, fragmentNs, resampledNs;
};

double msOf(const Costs& costs, const FrameAmounts& amounts) {
    return costs.frameMs +
           1e-6 * (costs.seenNs * amounts.seenTriangles + costs.drawnNs * amounts.drawnTriangles +
                   costs.fragmentNs * amounts.fragments + costs.resampledNs * amounts.resampledPx);
}

constexpr double kFacingEye = 0.5;  // of the triangles of closed shapes

constexpr Costs kPlainCosts{2, 0, 60, 6, 0};
constexpr Costs kPieceCosts{8, 600, 150, 7, 0};
constexpr Costs kImageCosts{4, 0, 60, 6, 8};
constexpr Costs kTriangleBoundCosts{4, 3000, 0, 60, 0};
constexpr Costs kQuadBoundCosts{4, 1500, 0, 90, 0};
constexpr Costs kWarpCosts{4, 300, 400, 7, 0};

// A triangle is drawn once for each piece that it touches: as many as its box of pieces holds.
double pairsOf(const Facts& facts, int pieces) {
    const double piecePx = std::sqrt(facts.shown.shownPx / pieces);
    const double triangles = facts.scene.seenTriangles;
    const double edgesPx = std::sqrt(triangles * facts.scene.squaredEdgesPx2);
    return kFacingEye *
           (triangles + edgesPx / piecePx + facts.scene.squaredEdgesPx2 / (piecePx * piecePx) / 4);
}

MethodForecast piecewiseForecast(const Facts& facts) {
    MethodForecast forecast{facts.request, facts.request.pieces->certificate.maxPx};
    forecast.request.method = Method::piecewise;
    const auto pieces = static_cast<int>(facts.request.pieces->mesh.pieces.size());
    const double triangles = facts.scene.seenTriangles, px = facts.shown.shownPx;
    const double pairs = pieces == 1 ? triangles : pairsOf(facts, pieces);
    forecast.amounts = {triangles, pairs, facts.fragments(px), 0};
    forecast.frameMs = msOf(pieces == 1 ? kPlainCosts : kPieceCosts, forecast.amounts);
    return forecast;
}

// Half the diagonal of a texel, where one is as large as a pixel of the display's densest place.
constexpr double kErrorOfATexel = 0.7072;

// `source` has one texel for one pixel there.
MethodForecast imageBasedForecast(const Facts& facts, SourceKind kind, const ImageSource& source) {
    const double finer = kErrorOfATexel / facts.request.tolerancePx;
    const double needed = std::ceil(source.faceSizePx * finer);
    if (needed > kMostFacePx)
        throw UsageError(
            fmt::format("{} px along its faces would be needed, and {} are the most", needed, kMostFacePx));
    MethodForecast forecast{facts.request, facts.request.tolerancePx};
    forecast.request.method = Method::imageBased;
    forecast.request.source = kind;
    forecast.request.faceSizePx = std::max(static_cast<int>(needed), kLeastFacePx);
    const auto texels = finer * finer * static_cast<double>(texelCountOf(source));
    const auto pictures = static_cast<double>(source.faces.size());
    forecast.amounts = {0, facts.scene.triangles * std::min(pictures / 4, 1.5), facts.fragments(texels),
                        facts.shown.shownPx};
    forecast.frameMs = msOf(kImageCosts, forecast.amounts);
    return forecast;
}

// Exact, but for how floats round.
MethodForecast boundedRaycastForecast(const Facts& facts, BoundingShape bounds) {
    roundLensOf(facts.display);
    MethodForecast forecast{facts.request, 0};
    forecast.request.method = Method::boundedRaycast;
    forecast.request.bounds = bounds;
    forecast.amounts = {facts.scene.seenTriangles, 0, facts.fragments(facts.shown.shownPx), 0};
    forecast.frameMs =
        msOf(bounds == BoundingShape::triangle ? kTriangleBoundCosts : kQuadBoundCosts, forecast.amounts);
    return forecast;
}

// A triangle may lie further from its straight image than its edges do from theirs.
constexpr double kErrorOfAnEdge = 1.5;

MethodForecast vertexWarpForecast(const Facts& facts) {
    if (std::isinf(facts.shown.bendPx))
        throw UsageError("what the display shows is torn somewhere, and edges that cross it bend at will");
    const double edgePx =
        std::sqrt(facts.request.tolerancePx / std::max(kErrorOfAnEdge * facts.shown.bendPx, 1e-12));
    if (edgePx < kLeastTessellationPx)
        throw UsageError(fmt::format("edges of {:.2f} px would be needed, and {} px are the least", edgePx,
                                     kLeastTessellationPx));
    MethodForecast forecast{facts.request, facts.request.tolerancePx};
    forecast.request.method = Method::vertexWarp;
    const bool shortEnough = facts.scene.longestEdgePx <= edgePx;
    forecast.request.tessellationPx = shortEnough ? 0 : std::min(edgePx, kMostTessellationPx);
    const double parts = facts.scene.seenTriangles + facts.scene.squaredEdgesPx2 / (edgePx * edgePx);
    forecast.amounts = {facts.scene.seenTriangles, kFacingEye * parts, facts.fragments(facts.shown.shownPx),
                        0};
    forecast.frameMs = msOf(kWarpCosts, forecast.amounts);
    return forecast;
}

}  // namespace

MethodChoice forecastMethods(const RenderRequest& request, const Display& display) {
    Facts facts{request, display, factsOf(display), {}};
    facts.scene =
        factsOf(*request.scene, sceneViewOf(request.camera, request.wall->eyeM, *request.scene), facts.shown);
    MethodChoice choice{{piecewiseForecast(facts)}, {}};
    if (request.pieces->mesh.pieces.size() == 1) {
        choice.ruledOut.push_back("the others: one plain draw is what the display needs");
        return choice;
    }
    const auto consider = [&](std::string_view name, const auto& forecast) {
        try {
            choice.forecasts.push_back(forecast());
        } catch (const UsageError& error) {
            choice.ruledOut.push_back(fmt::format("{}: {}", name, error.what()));
        }
    };
    PixelRays rays(*display.projection, display.sizePx);
    rays.keep({});
    consider("image-based, cube",
             [&] { return imageBasedForecast(facts, SourceKind::cube, cubeSource(rays, 0)); });
    consider("image-based, planar",
             [&] { return imageBasedForecast(facts, SourceKind::planar, planarSource(rays, 0)); });
    for (const BoundingShape bounds : {BoundingShape::triangle, BoundingShape::quad})
        consider(fmt::format("bounded-raycast, {}", nameOf(bounds)),
                 [&] { return boundedRaycastForecast(facts, bounds); });
    consider("vertex-warp", [&] { return vertexWarpForecast(facts); });
    std::ranges::stable_sort(choice.forecasts, {}, &MethodForecast::frameMs);
    return choice;
}

std::string settingsOf(const RenderRequest& request) {
    const std::string_view name = nameOf(request.method);
    switch (request.method) {
        case Method::imageBased:
            return fmt::format("{}, {} of {} px", name, nameOf(request.source), request.faceSizePx);
        case Method::boundedRaycast:
            return fmt::format("{}, {}", name, nameOf(request.bounds));
        case Method::vertexWarp:
            return request.tessellationPx > 0
                       ? fmt::format("{}, edges of {:.1f} px", name, request.tessellationPx)
                       : std::string(name);
        case Method::piecewise:
        case Method::reference:
        case Method::automatic:
            break;
    }
    return std::string(name);
}

}  // namespace curvewall
