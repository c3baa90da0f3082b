#include "renderer/method_choice.h"

#include "calibration/angles.h"
#include "calibration/errors.h"
#include "calibration/pieces/piece_fit.h"
#include "renderer/cube_source.h"
#include "renderer/names.h"
#include "renderer/planar_source.h"
#include "renderer/request_limits.h"
#include "renderer/round_lens.h"
#include "renderer/scene_facts.h"

#include <fmt/core.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
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

constexpr Costs kPlainCosts{5, 300, 20, 5, 0};
constexpr Costs kPieceCosts{13, 600, 560, 3, 0};
constexpr Costs kImageCosts{10, 0, 300, 4, 30};
constexpr Costs kTriangleBoundCosts{15, 4500, 0, 21, 0};
constexpr Costs kQuadBoundCosts{5, 3500, 0, 45, 0};
constexpr Costs kWarpCosts{35, 1500, 250, 2, 0};

// Of all pieces, as they are seen from the eye, in mean pixels.
double perimetersPx(const Facts& facts) {
    const PieceMesh& mesh = facts.request.pieces->mesh;
    double sumRad = 0;
    for (const Piece& piece : mesh.pieces)
        for (uint32_t i = 0; i < piece.vertexCount; ++i)
            sumRad += angleBetween(mesh.vertices[piece.vertices[i]].m,
                                   mesh.vertices[piece.vertices[(i + 1) % piece.vertexCount]].m);
    return sumRad * std::sqrt(facts.shown.shownPx / facts.shown.solidAngleSr);
}

// A triangle is drawn once for each piece that it touches. Convex shapes of areas A and a and perimeters P
// and p, thrown onto an area W, touch with the probability (A + a + P p / 2 pi) / W (Santalo, Integral
// Geometry and Geometric Probability, 1976); triangles are taken as equilateral ones.
double pairsOf(const Facts& facts) {
    const double triangles = facts.scene.seenTriangles, areaPx2 = facts.shown.shownPx;
    const auto pieces = static_cast<double>(facts.request.pieces->mesh.pieces.size());
    const double edgesPx = std::sqrt(triangles * facts.scene.squaredEdgesPx2);
    const double crossings = perimetersPx(facts) * 3 * edgesPx / (2 * std::numbers::pi * areaPx2);
    const double held = pieces * std::sqrt(3) / 4 * facts.scene.squaredEdgesPx2 / areaPx2;
    return kFacingEye * (triangles + crossings + held);
}

MethodForecast piecewiseForecast(const Facts& facts) {
    MethodForecast forecast{facts.request, facts.request.pieces->certificate.maxPx};
    forecast.request.method = Method::piecewise;
    const auto pieces = static_cast<int>(facts.request.pieces->mesh.pieces.size());
    const double triangles = facts.scene.seenTriangles, px = facts.shown.shownPx;
    const double pairs = pieces == 1 ? triangles : pairsOf(facts);
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
constexpr double kErrorOfAnEdge = 3;

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
