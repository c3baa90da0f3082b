#include "bench/speed/walls.h"

#include "bench/request.h"
#include "calibration/pieces/ownership.h"
#include "calibration/projections/camera_texture.h"
#include "calibration/projections/frustum.h"
#include "tests/support/shipped_walls.h"
#include "tests/support/test_walls.h"

#include <cmath>
#include <utility>

namespace curvewall {
namespace {

constexpr glm::ivec2 kSizePx(1600, 1200);
constexpr glm::ivec2 kDomeSizePx(2048, 2048);

// The formula of scripts/make-config-maps at 80 x 60 nodes.
NumberMap projectorOffsets() {
    NumberMap map{{80, 60}, 2, false, {}};
    for (int j = 0; j < map.sizePx.y; ++j) {
        for (int i = 0; i < map.sizePx.x; ++i) {
            const double x = double(i) / (map.sizePx.x - 1) - 0.5, y = double(j) / (map.sizePx.y - 1) - 0.5;
            const double dx = kSizePx.x * (-0.10 * x * (4 * x * x - 1) + 0.02 * y);
            const double dy = kSizePx.y * (0.14 * y * (1 - 4 * x * x) - 0.03 * x * (1 - 2 * x));
            map.values.insert(map.values.end(), {static_cast<float>(dx), static_cast<float>(dy)});
        }
    }
    return map;
}

Wall squareWall(const PlanarScreen& screen) {
    auto projection = std::make_shared<PlanarProjection>(screen, glm::dvec3(0), kDomeSizePx);
    return {"square", {}, {}, {{"square", kDomeSizePx, "planar", std::move(projection)}}};
}

// Of the picture that the offsets deform, a metre ahead; `at` in shares of its width and height.
constexpr glm::dvec2 kHalfPictureM(1, 0.75);
glm::dvec3 picturePoint(glm::dvec2 at) {
    const glm::dvec2 m = kHalfPictureM * (2.0 * at - 1.0);
    return {m.x, -m.y, -1};
}

Wall cameraTextureWall() {
    const NodeMeaning offsets{.isOffset = true};
    auto map = std::make_shared<const GridMap>(projectorOffsets(), offsets, kSizePx, Alignment::corners);
    const double across = std::atan(kHalfPictureM.x), up = std::atan(kHalfPictureM.y);
    auto base = std::make_shared<FrustumProjection>(Frustum{-across, across, -up, up, {}}, kSizePx);
    auto projection = std::make_shared<CameraTexture>(std::move(map), std::move(base), MapDirection::forward);
    return {"camera texture", {}, {}, {{"projector", kSizePx, "camera_texture", std::move(projection)}}};
}

// As many cells in each row and column; `vertexAt` takes shares of the width and the height.
template <class VertexAt>
std::shared_ptr<const FittedPieces> evenPieces(glm::ivec2 cells, bool quads, const VertexAt& vertexAt) {
    PieceGrid grid{kSizePx, cells.x, cells.y, {}};
    for (int row = 0; row <= cells.y; ++row)
        for (int column = 0; column <= cells.x; ++column)
            grid.vertices.push_back(vertexAt(glm::dvec2(column, row) / glm::dvec2(cells)));
    auto pieces = std::make_shared<FittedPieces>();
    pieces->mesh = meshFromGrid(grid, quads);
    pieces->owners = std::make_shared<const std::vector<int32_t>>(ownerImage(pieces->mesh));
    return pieces;
}

}  // namespace

PieceWall fittedWall(std::string name, Wall wall, double tolerancePx) {
    auto pieces = std::make_shared<const FittedPieces>(fitPieces(wall.displays[0], tolerancePx));
    return {std::move(name), std::make_shared<const Wall>(std::move(wall)), tolerancePx, std::move(pieces)};
}

PieceWall fullCylinder(double tolerancePx) {
    return fittedWall("full cylinder", test::shippedWall("full-cylinder"), tolerancePx);
}

PieceWall domeMaster(double tolerancePx) {
    return fittedWall("dome master", test::shippedWall("dome-master"), tolerancePx);
}

PieceWall planar90() { return fittedWall("planar 90", test::shippedWall("planar-90"), kDefaultTolerancePx); }

PieceWall quarterCylinder() {
    const CylinderWall quarter{2, test::kPi / 2, 2 * test::kPi / 2 * kSizePx.y / kSizePx.x, {}, {}};
    return fittedWall("quarter cylinder", test::cylinderWall(quarter, {}, kSizePx), 0.25);
}

PieceWall cameraTexture(double tolerancePx) {
    return fittedWall("camera texture", cameraTextureWall(), tolerancePx);
}

PieceWall squareAhead() {
    return fittedWall("planar 2048 ahead", test::planarWall(kDomeSizePx, 90), kDefaultTolerancePx);
}

PieceWall squareUp() {
    const PlanarScreen ceiling{{-1, 1, -1}, {1, 1, -1}, {-1, 1, 1}};
    return fittedWall("planar 2048 up", squareWall(ceiling), kDefaultTolerancePx);
}

PieceWall evenCylinder(glm::ivec2 cells) {
    const CylinderWall cylinder = test::fullCylinder(kSizePx);
    const auto vertexAt = [&](glm::dvec2 at) {
        const glm::dvec2 s = snapToGrid(at * glm::dvec2(kSizePx));
        const double angle = 2 * test::kPi * (s.x / kSizePx.x - 0.5);
        return PieceVertex{{cylinder.radiusM * std::sin(angle), cylinder.heightM * (0.5 - s.y / kSizePx.y),
                            -cylinder.radiusM * std::cos(angle)},
                           s};
    };
    return {"even cylinder", std::make_shared<const Wall>(test::fullCylinderWall(kSizePx)),
            kDefaultTolerancePx, evenPieces(cells, true, vertexAt)};
}

PieceWall evenCameraTexture(glm::ivec2 cells) {
    auto wall = std::make_shared<const Wall>(cameraTextureWall());
    // On the plane of the base picture, which the map takes to the display.
    const auto vertexAt = [&](glm::dvec2 at) {
        const glm::dvec3 m = picturePoint(at);
        return PieceVertex{m, snapToGrid(wall->displays.front().projection->project(m).at(0))};
    };
    return {"even camera texture", wall, kDefaultTolerancePx, evenPieces(cells, false, vertexAt)};
}

RenderRequest requestFor(const PieceWall& wall, const ScenePtr& scene, int frames) {
    RenderRequest request = requestFor(wall.wall, scene, frames);
    request.tolerancePx = wall.tolerancePx;
    request.pieces = wall.pieces;
    request.timesStages = true;
    return request;
}

}  // namespace curvewall
