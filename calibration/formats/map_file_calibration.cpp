#include "calibration/formats/map_file_calibration.h"

#include "calibration/errors.h"
#include "calibration/files/pfm_file.h"
#include "calibration/formats/display_names.h"
#include "calibration/formats/map_decisions.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

namespace curvewall {
namespace {

enum class MapKind { surface, inverse, forward };
enum class StereoHalf { none, left, right };

// The left and right half hold nearly the same numbers; nothing where they do not. The answer is the largest
// difference.
std::optional<double> differenceOfHalves(const NumberMap& map) {
    constexpr double kSame = 0.02, kSpan = 0.2;
    const int half = map.sizePx.x / 2;
    if (map.sizePx.x % 2 != 0 || half < 2 || map.channels < 2) return std::nullopt;
    double largest = 0;
    float low = INFINITY, high = -INFINITY;
    for (int y = 0; y < map.sizePx.y; ++y)
        for (int x = 0; x < half; ++x) {
            const float* left = map.at(x, y);
            const float* right = map.at(x + half, y);
            const bool isNode = std::isfinite(left[0] + left[1]);
            if (isNode != std::isfinite(right[0] + right[1])) return std::nullopt;
            if (!isNode) continue;
            largest = std::max({largest, std::abs(static_cast<double>(left[0]) - right[0]),
                                std::abs(static_cast<double>(left[1]) - right[1])});
            low = std::min(low, left[0]);
            high = std::max(high, left[0]);
        }
    if (!(largest < kSame && high - low > kSpan)) return std::nullopt;
    return largest;
}

NumberMap columnsOf(const NumberMap& map, int begin, int count) {
    NumberMap part{{count, map.sizePx.y}, map.channels, map.isInteger, {}};
    for (int y = 0; y < map.sizePx.y; ++y) {
        const float* row = map.at(begin, y);
        part.values.insert(part.values.end(), row, row + static_cast<ptrdiff_t>(count) * map.channels);
    }
    return part;
}

NumberMap decideHalf(NumberMap map, Decisions& decisions) {
    const auto difference = differenceOfHalves(map);
    if (!difference) return map;
    const int half = map.sizePx.x / 2;
    switch (decisions.choose<StereoHalf>(
        "stereo_half", {{"none", StereoHalf::none}, {"left", StereoHalf::left}, {"right", StereoHalf::right}},
        StereoHalf::left,
        fmt::format("the {} columns hold the same map twice, to {:.2g}: one for each eye", map.sizePx.x,
                    *difference))) {
        case StereoHalf::left:
            return columnsOf(map, 0, half);
        case StereoHalf::right:
            return columnsOf(map, half, half);
        case StereoHalf::none:
            break;
    }
    return map;
}

MapKind decideKind(const NumberMap& map, const MapSurvey& s, bool hadHalves, Decisions& decisions) {
    constexpr double kOutside = 1;  // of the picture on either side
    const bool isOutside =
        std::min(s.low.x, s.low.y) < -kOutside || std::max(s.high.x, s.high.y) > 1 + kOutside;
    const std::string range = fmt::format("the numbers are {:.3f} to {:.3f} and {:.3f} to {:.3f}", s.low.x,
                                          s.high.x, s.low.y, s.high.y);
    MapKind guess = MapKind::inverse;
    std::string evidence = range + ", and the third channel says nothing";
    if (map.channels > 2 && !s.thirdIsNan && (!s.thirdIsZero || isOutside)) {
        guess = MapKind::surface;
        evidence = "three channels of numbers: points";
    } else if (hadHalves) {
        guess = MapKind::forward;
        evidence = range + ", twice side by side, as SGCT reads forward maps of two eyes";
    } else if (looksLikeOffsets(s)) {
        guess = MapKind::forward;
        evidence = range + ": offsets, as Evans & Sutherland wrote them in 2017";
    }
    return decisions.choose<MapKind>(
        "map_kind",
        {{"surface", MapKind::surface}, {"inverse", MapKind::inverse}, {"forward", MapKind::forward}}, guess,
        evidence);
}

// Large maps have a node for every pixel.
glm::ivec2 decideMapSize(const CalibrationRequest& request, glm::ivec2 nodes, Decisions& decisions) {
    constexpr int kFewNodes = 400;
    if (request.sizePx || std::min(nodes.x, nodes.y) < kFewNodes || std::max(nodes.x, nodes.y) > kMostPx)
        return decideSize(request, std::nullopt, std::nullopt, decisions);
    const std::string why = "the file names no resolution; so many nodes are one for each pixel";
    const auto side = [&](const char* key, int count) {
        return static_cast<int>(decisions.number(key, {1, double{kMostPx}}, count, why));
    };
    const int width = side("width_px", nodes.x);
    return {width, side("height_px", nodes.y)};
}

}  // namespace

bool isMapFile(const FileBytes& file) { return isPfm(file.bytes) || isExr(file.bytes); }

Wall readMapFile(const FileBytes& file, const FindFile&, const CalibrationRequest& request,
                 Decisions& decisions) {
    NumberMap map = readNumberMap(file);
    if (map.channels < 2)
        throw InputError(file.path, "", "a map of two or three channels", "one of one channel");
    const int columns = map.sizePx.x;
    decideScale(map, decisions);
    map = decideHalf(std::move(map), decisions);
    MapFile described{map, surveyMap(map, isPfm(file.bytes)), isPfm(file.bytes), {}, file.name()};
    if (!described.survey.hasNodes) throw InputError(file.path, "", "a map", "no valid sample anywhere");
    const MapKind kind = decideKind(map, described.survey, map.sizePx.x != columns, decisions);

    Wall wall{.name = file.stem(), .eyeM = request.eyeM.value_or(glm::dvec3(0))};
    Display display;
    display.name = safeDisplayName(file.stem());
    display.sizePx = described.sizePx = decideMapSize(request, map.sizePx, decisions);
    if (kind == MapKind::surface) {
        const PointFrame frame = decideFrame({}, described.survey, decisions);
        const bool bottomRowFirst = decideBottomRowFirst(described, decisions);
        display.projectionType = "surface_map";
        display.projection =
            projectionOfSurface(map, frame, bottomRowFirst, decideAlignment(described, decisions),
                                display.sizePx, wall.eyeM, file.path);
    } else {
        const bool isOffset = decisions.choose<bool>(
            "map_values", {{"absolute", false}, {"offset", true}}, looksLikeOffsets(described.survey),
            fmt::format("their mean is ({:.3f}, {:.3f})", described.survey.mean.x, described.survey.mean.y));
        const MapMeaning meaning =
            decideMeaning(described, kind == MapKind::inverse ? MapDirection::inverse : MapDirection::forward,
                          isOffset, decisions);
        display.projectionType = meaning.cells.empty() ? "camera_texture" : "warp_mesh";
        const SourcePicture source = request.source
                                         ? *request.source
                                         : decideSource(false, "the map does not say what its picture shows",
                                                        display.sizePx, decisions);
        display.projection = projectionOfMap(map, meaning, display.sizePx, source, file.path);
    }
    listDecisions(decisions, display);
    wall.displays.push_back(std::move(display));
    return wall;
}

}  // namespace curvewall
