#include "renderer/method_choice.h"

#include "calibration/pieces/piece_fit.h"
#include "renderer/cube_source.h"
#include "renderer/names.h"
#include "renderer/request_limits.h"
#include "renderer/scene_facts.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace curvewall {
namespace {

struct Facts {
    const RenderRequest& request;
    const Display& display;
    DisplayFacts shown;
    SceneFacts scene;

    double fragments(double px) const { return scene.fragmentsAPixel * px; }
};

// What a frame takes is a sum over how much there is of each.
struct Amounts {
    double seenTriangles = 0;   // looked at
    double drawnTriangles = 0;  // by the rasterizer
    double fragments = 0;
    double resampledPx = 0;
};

// Fitted to what `curvewall_speed methods` measured (docs/auto.md).
struct Costs {
    double frameMs, seenNs, drawnNs, fragmentNs, resampledNs;
};

double msOf(const Costs& costs, const Amounts& amounts) {
    return costs.frameMs +
           1e-6 * (costs.seenNs * amounts.seenTriangles + costs.drawnNs * amounts.drawnTriangles +
                   costs.fragmentNs * amounts.fragments + costs.resampledNs * amounts.resampledPx);
}

constexpr double kFacingEye = 0.5;  // of the triangles of closed shapes

constexpr Costs kPlainCosts{2, 0, 60, 6, 0};
constexpr Costs kPieceCosts{8, 600, 150, 7, 0};
constexpr Costs kImageCosts{4, 0, 60, 6, 8};

// A triangle is drawn once for each piece that it touches: as many as its box of pieces holds.
double pairsOf(const Facts& facts, int pieces) {
    const double piecePx = std::sqrt(facts.shown.shownPx / pieces);
    const double triangles = facts.scene.seenTriangles;
    const double edgesPx = std::sqrt(triangles * facts.scene.squaredEdgesPx2);
    return kFacingEye *
           (triangles + edgesPx / piecePx + facts.scene.squaredEdgesPx2 / (piecePx * piecePx) / 4);
}

MethodForecast piecewiseForecast(const Facts& facts) {
    MethodForecast forecast{facts.request, facts.request.pieces->certificate.maxPx, 0};
    forecast.request.method = Method::piecewise;
    const auto pieces = static_cast<int>(facts.request.pieces->mesh.pieces.size());
    const double triangles = facts.scene.seenTriangles, px = facts.shown.shownPx;
    forecast.frameMs = pieces == 1
                           ? msOf(kPlainCosts, {0, triangles, facts.fragments(px), 0})
                           : msOf(kPieceCosts, {triangles, pairsOf(facts, pieces), facts.fragments(px), 0});
    return forecast;
}

// Half the diagonal of a texel, where one is as large as a pixel of the display's densest place.
constexpr double kErrorOfATexel = 0.7072;

std::optional<MethodForecast> imageBasedForecast(const Facts& facts, std::vector<std::string>& ruledOut) {
    PixelRays rays(*facts.display.projection, facts.display.sizePx);
    const ImageSource source = cubeSource(rays, 0);
    const double faces = static_cast<double>(source.faces.size());
    const double needed = std::ceil(source.faceSizePx * kErrorOfATexel / facts.request.tolerancePx);
    if (needed > kMostFacePx) {
        ruledOut.push_back("image-based: faces of " + std::to_string(static_cast<int64_t>(needed)) +
                           " px would be needed, and " + std::to_string(kMostFacePx) + " px are the most");
        return std::nullopt;
    }
    MethodForecast forecast{facts.request, facts.request.tolerancePx, 0};
    forecast.request.method = Method::imageBased;
    forecast.request.faceSizePx = static_cast<int>(needed);
    const double texels = faces * needed * needed;
    forecast.frameMs = msOf(kImageCosts, {0, facts.scene.triangles * std::min(faces / 6 * 1.5, 1.5),
                                          facts.fragments(texels), facts.shown.shownPx});
    return forecast;
}

}  // namespace

MethodChoice forecastMethods(const RenderRequest& request, const Display& display) {
    Facts facts{request, display, factsOf(display), {}};
    facts.scene =
        factsOf(*request.scene, sceneViewOf(request.camera, request.wall->eyeM, *request.scene), facts.shown);
    MethodChoice choice{{piecewiseForecast(facts)}, {}};
    if (auto forecast = imageBasedForecast(facts, choice.ruledOut))
        choice.forecasts.push_back(std::move(*forecast));
    std::ranges::stable_sort(choice.forecasts, {}, &MethodForecast::frameMs);
    return choice;
}

std::string settingsOf(const RenderRequest& request) {
    std::string settings(nameOf(request.method));
    if (request.method == Method::imageBased)
        settings += ", faces of " + std::to_string(request.faceSizePx) + " px";
    return settings;
}

}  // namespace curvewall
