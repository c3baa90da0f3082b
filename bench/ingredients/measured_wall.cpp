#include "bench/ingredients/measured_wall.h"

#include "calibration/pieces/certificate.h"
#include "calibration/pieces/ownership.h"
#include "calibration/projections/lens_projection.h"
#include "calibration/projections/radial_lens.h"
#include "tests/support/shipped_walls.h"

#include <algorithm>
#include <limits>
#include <numbers>

namespace curvewall {
namespace {

constexpr double kPi = std::numbers::pi;

MeasuredWall measuredWall(const std::string& name, glm::ivec2 sizePx, const ProjectionPtr& projection,
                          Surface surface, std::vector<double> rowsPerColumn) {
    return {name, projection, projection, sizePx, surface, std::move(rowsPerColumn), 0};
}

MeasuredWall shippedDisplay(const std::string& name, const std::string& stem, Surface surface,
                            std::vector<double> rowsPerColumn) {
    const Display display = test::shippedWall(stem).displays.front();
    return measuredWall(name, display.sizePx, display.projection, surface, std::move(rowsPerColumn));
}

// The most slanted projector of configs/five-projector-dome.json, from a seat away from the dome's centre.
MeasuredWall projectorOnDome(std::vector<double> rowsPerColumn) {
    const Wall wall = seenFrom(test::shippedWall("five-projector-dome"), {1.2, -0.4, 0.8});
    const Display& display = findDisplay(wall, "zenith");
    return measuredWall("projector on a dome", display.sizePx, display.projection, Surface::measured,
                        std::move(rowsPerColumn));
}

// The lens of configs/dome-master.json, up to an angle off its axis.
ProjectionPtr domeMasterTo(double edgeRad) {
    constexpr double kRadiusPx = 1024;
    return std::make_shared<LensProjection>(
        std::make_shared<RadialLens>(RadialFunction{RadialModel::equidistant}, glm::dvec2(kRadiusPx),
                                     glm::dvec2(kRadiusPx / (kPi / 2)), edgeRad),
        Orientation{.pitchRad = kPi / 2});
}

}  // namespace

std::vector<MeasuredWall> measuredWalls() {
    const std::vector<double> square{1}, anyShape{0, 0.125, 0.25, 0.5, 1};
    std::vector<MeasuredWall> walls;
    walls.push_back(shippedDisplay("full cylinder", "full-cylinder", Surface::measured, anyShape));
    walls.push_back(shippedDisplay("dome master", "dome-master", Surface::infinity, square));
    walls.back().continued = domeMasterTo(kPi);
    walls.push_back(shippedDisplay("view deformation", "view-deformation", Surface::image, square));
    walls.back().mapColumns = 63;  // 64 nodes from border to border
    walls.push_back(shippedDisplay("measured screen", "surface-map", Surface::measured, anyShape));
    walls.back().mapColumns = 130;  // 65 nodes in the middles of columns
    walls.push_back(projectorOnDome(anyShape));
    return walls;
}

Measured measure(const Projection& projection, const PieceMesh& mesh, double tolerancePx) {
    constexpr int kFewPixels = 8;  // rows and columns apart
    const auto maxPx = [](const Certificate& certificate) {
        return certificate.uncoveredPixels > 0 ? std::numeric_limits<double>::infinity() : certificate.maxPx;
    };
    const double fewMaxPx = maxPx(certifyPieces(projection, mesh, {}, kFewPixels).certificate);
    if (fewMaxPx > tolerancePx) return {fewMaxPx, 0};
    const CertifiedPixels pixels = certifyPieces(projection, mesh);
    std::vector<bool> isSeen(mesh.pieces.size());
    for (int32_t owner : pixels.owners)
        if (owner != kNoPiece) isSeen[static_cast<size_t>(owner)] = true;
    return {maxPx(pixels.certificate), static_cast<size_t>(std::ranges::count(isSeen, true))};
}

}  // namespace curvewall
