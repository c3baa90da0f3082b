#include "calibration/formats/map_calibration.h"

#include "calibration/errors.h"
#include "calibration/projections/grid_map.h"
#include "calibration/projections/surface_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

namespace curvewall {
namespace {

constexpr int64_t kMostMeshNodes = int64_t{1} << 22;
constexpr double kNoPoint = 1e-5;

void requireNodes(const NumberMap& map, int channels, const std::string& path) {
    if (map.channels < channels)
        throw InputError(path, "", fmt::format("at least {} channels", channels),
                         std::to_string(map.channels));
    if (map.sizePx.x < 2 || map.sizePx.y < 2)
        throw InputError(path, "", "at least 2 x 2 nodes",
                         fmt::format("{} x {}", map.sizePx.x, map.sizePx.y));
}

// For a GridMap or a MeasuredSurface.
template <class Map>
void refuseEmpty(const Map& map, const std::string& path) {
    if (!map.hasSamples()) throw InputError(path, "", "a map", "no valid sample anywhere");
    if (!map.hasArea())
        throw InputError(path, "", "a map that covers an area",
                         "one that collapses everywhere: no cell with valid corners has an area");
}

// Where a node lies, in fractions of the display or of the source, y down.
glm::dvec2 placeOf(const NumberMap& map, const MapMeaning& meaning, int x, int y) {
    const glm::dvec2 index(x, meaning.bottomRowFirst ? map.sizePx.y - 1 - y : y);
    return meaning.alignment == Alignment::centers ? (index + 0.5) / glm::dvec2(map.sizePx)
                                                   : index / glm::dvec2(map.sizePx - 1);
}

// The number of a node as a position from the top left corner; nothing where it was not measured.
std::optional<glm::dvec2> valueOf(const NumberMap& map, const MapMeaning& meaning, int x, int y) {
    const float* number = map.at(x, y);
    glm::dvec2 value(number[0], number[1]);
    if (!std::isfinite(value.x) || !std::isfinite(value.y) || value == glm::dvec2(-1)) return std::nullopt;
    if (meaning.yUp) value.y = (meaning.isOffset ? 0 : 1) - value.y;
    return meaning.isOffset ? value + placeOf(map, meaning, x, y) : value;
}

glm::dvec2 inRect(const PictureRect& rect, glm::dvec2 fraction) { return rect.origin + rect.size * fraction; }

// Positions in the source, in its pixels, from the top row down.
NumberMap sourcePositions(const NumberMap& map, const MapMeaning& meaning) {
    NumberMap positions{map.sizePx, 2, false, {}};
    positions.values.reserve(2 * static_cast<size_t>(map.sizePx.x) * static_cast<size_t>(map.sizePx.y));
    for (int row = 0; row < map.sizePx.y; ++row)
        for (int x = 0; x < map.sizePx.x; ++x) {
            const int y = meaning.bottomRowFirst ? map.sizePx.y - 1 - row : row;
            const auto value = valueOf(map, meaning, x, y);
            const glm::vec2 position =
                value ? glm::vec2(*value) : glm::vec2(std::numeric_limits<float>::quiet_NaN());
            positions.values.insert(positions.values.end(), {position.x, position.y});
        }
    return positions;
}

ProjectionPtr inverseProjection(const NumberMap& map, const MapMeaning& meaning, glm::ivec2 sizePx,
                                const SourcePicture& source, const std::string& path) {
    NodeMeaning inPixels;
    inPixels.gain = meaning.sourceRect.size * source.sizePx;
    inPixels.bias = meaning.sourceRect.origin * source.sizePx;
    inPixels.border = BorderCells::straight;
    auto grid =
        std::make_shared<const GridMap>(sourcePositions(map, meaning), inPixels, sizePx, meaning.alignment);
    refuseEmpty(*grid, path);
    return std::make_shared<CameraTexture>(std::move(grid), source.projection, MapDirection::inverse);
}

}  // namespace

ProjectionPtr projectionOfMap(const NumberMap& map, const MapMeaning& meaning, glm::ivec2 sizePx,
                              const SourcePicture& source, const std::string& path) {
    requireNodes(map, 2, path);
    if (meaning.direction == MapDirection::inverse && meaning.cells.empty())
        return inverseProjection(map, meaning, sizePx, source, path);
    return meshOnDisplay(meshOfMap(map, meaning, path), sizePx, source, 1, path).projection;
}

MeshCalibration meshOfMap(const NumberMap& map, const MapMeaning& meaning, const std::string& path) {
    requireNodes(map, 2, path);
    if (int64_t{map.sizePx.x} * map.sizePx.y > kMostMeshNodes)
        throw InputError(path, "", fmt::format("at most {} nodes of a mesh", kMostMeshNodes),
                         fmt::format("{} x {}", map.sizePx.x, map.sizePx.y));
    MeshCalibration mesh;
    mesh.cells = meaning.cells;
    for (int row = 0; row < map.sizePx.y; ++row)
        for (int x = 0; x < map.sizePx.x; ++x) {
            const int y = meaning.bottomRowFirst ? map.sizePx.y - 1 - row : row;
            const auto value = valueOf(map, meaning, x, y);
            mesh.vertices.emplace_back();
            if (!value) continue;
            const glm::dvec2 place = placeOf(map, meaning, x, y);
            if (meaning.direction == MapDirection::forward)
                mesh.vertices.back() = {*value, inRect(meaning.sourceRect, place)};
            else
                mesh.vertices.back() = {place, inRect(meaning.sourceRect, *value)};
        }
    return mesh;
}

ProjectionPtr projectionOfSurface(const NumberMap& points, const PointFrame& frame, bool bottomRowFirst,
                                  Alignment alignment, glm::ivec2 sizePx, glm::dvec3 eyeM,
                                  const std::string& path) {
    requireNodes(points, 3, path);
    NumberMap inWall{points.sizePx, 3, false, {}};
    inWall.values.reserve(3 * static_cast<size_t>(points.sizePx.x) * static_cast<size_t>(points.sizePx.y));
    for (int y = 0; y < points.sizePx.y; ++y)
        for (int x = 0; x < points.sizePx.x; ++x) {
            const float* number = points.at(x, y);
            const glm::dvec3 point(number[0], number[1], number[2]);
            const bool isPoint = std::isfinite(point.x) && std::isfinite(point.y) && std::isfinite(point.z) &&
                                 largestCoordinate(point) >= kNoPoint;
            const glm::vec3 moved =
                isPoint ? glm::vec3(frame.unitM * (frame.wallFromFile * point) + frame.originM)
                        : glm::vec3(std::numeric_limits<float>::quiet_NaN());
            inWall.values.insert(inWall.values.end(), {moved.x, moved.y, moved.z});
        }
    auto surface =
        std::make_shared<const MeasuredSurface>(std::move(inWall), bottomRowFirst, sizePx, alignment);
    refuseEmpty(*surface, path);
    return std::make_shared<SurfaceMap>(std::move(surface), 1, Pose{}, eyeM);
}

}  // namespace curvewall
