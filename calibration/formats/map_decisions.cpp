#include "calibration/formats/map_decisions.h"

#include <fmt/format.h>
#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace curvewall {
namespace {

enum class FileRows { bottomFirst, topFirst };

struct RowsGuess {
    FileRows rows;
    std::string evidence;
};

// By what the second number does from the first half of the rows to the last: a picture that is not upside
// down has the positions at its top in its top rows.
RowsGuess guessRows(const MapFile& map, bool yUp, bool isOffset, FileRows usual, Decisions& decisions) {
    constexpr double kSays = 0.05;
    const MapSurvey& s = map.survey;
    const char* order = map.isPfm ? "PFM files begin with the bottom row" : "pictures begin with the top row";
    if (isOffset || std::abs(s.firstRowsY - s.lastRowsY) < kSays) {
        if (yUp && map.isPfm) order = "programs that count upwards begin with the top row";
        return {usual, order};
    }
    const bool topFirst = yUp == (s.firstRowsY > s.lastRowsY);
    const FileRows upright = topFirst ? FileRows::topFirst : FileRows::bottomFirst;
    const std::string found = fmt::format(
        "the second number is {:.3f} on the average of the first rows and "
        "{:.3f} of the last",
        s.firstRowsY, s.lastRowsY);
    if (upright != usual)
        decisions.warn(
            fmt::format("{}: row order: {}, which is upside down where {}; it is taken the other "
                        "way round",
                        map.name, found, order));
    return {upright, found};
}

bool chooseTopFirst(const RowsGuess& guess, Decisions& decisions) {
    return decisions.choose<FileRows>(
               "row_order", {{"bottom_first", FileRows::bottomFirst}, {"top_first", FileRows::topFirst}},
               guess.rows, guess.evidence) == FileRows::topFirst;
}

// NumberMap has the rows of a PFM from its last one.
bool bottomRowFirst(const MapFile& map, bool fileIsTopFirst) { return map.isPfm == fileIsTopFirst; }

}  // namespace

MapSurvey surveyMap(const NumberMap& map, bool isPfm) {
    MapSurvey s;
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    s.low = glm::dvec2(kInfinity);
    s.high = -s.low;
    glm::dvec2 sum(0);
    double halves[2]{}, counts[2]{};
    bool hasThird = false;
    s.thirdIsZero = true;
    for (int y = 0; y < map.sizePx.y; ++y)
        for (int x = 0; x < map.sizePx.x; ++x) {
            const float* number = map.at(x, y);
            const glm::dvec2 value(number[0], map.channels > 1 ? number[1] : 0);
            if (!std::isfinite(value.x) || !std::isfinite(value.y) || value == glm::dvec2(-1)) continue;
            s.low = glm::min(s.low, value);
            s.high = glm::max(s.high, value);
            sum += value;
            const int rowInFile = isPfm ? map.sizePx.y - 1 - y : y;
            const int half = 2 * rowInFile < map.sizePx.y ? 0 : 1;
            halves[half] += value.y;
            ++counts[half];
            const double third = map.channels > 2 ? static_cast<double>(number[2]) : 0;
            if (!std::isfinite(third)) continue;
            hasThird = true;
            s.thirdIsZero = s.thirdIsZero && third == 0;
            s.extent = std::max({s.extent, std::abs(value.x), std::abs(value.y), std::abs(third)});
        }
    const double count = counts[0] + counts[1];
    s.hasNodes = count > 0;
    s.thirdIsNan = s.hasNodes && !hasThird;
    s.thirdIsZero = s.thirdIsZero && hasThird;
    if (!s.hasNodes) return {};
    s.mean = sum / count;
    s.firstRowsY = halves[counts[0] > 0 ? 0 : 1] / counts[counts[0] > 0 ? 0 : 1];
    s.lastRowsY = halves[counts[1] > 0 ? 1 : 0] / counts[counts[1] > 0 ? 1 : 0];
    return s;
}

bool looksLikeOffsets(const MapSurvey& s) {
    constexpr double kFarthest = 0.6, kNegative = -0.05, kNearZero = 0.15;
    const bool isSmall = std::max({-s.low.x, -s.low.y, s.high.x, s.high.y}) <= kFarthest;
    const bool isCentred = std::abs(s.mean.x) <= kNearZero && std::abs(s.mean.y) <= kNearZero;
    return isSmall && (isCentred || (s.low.x < kNegative && s.low.y < kNegative));
}

namespace {

bool isCoarseGrid(const MapFile& map) {
    return 2 * map.numbers.sizePx.x <= map.sizePx.x && 2 * map.numbers.sizePx.y <= map.sizePx.y;
}

// None for the bilinear cells of an inverse map.
std::vector<WarpCell> decideInverseCells(const MapFile& map, Decisions& decisions) {
    using Cut = std::optional<CellCut>;
    const Cut cut =
        decisions.choose<Cut>("interpolation",
                              {{"bilinear", std::nullopt},
                               {"triangles", CellCut::firstToLast},
                               {"triangles_across", CellCut::across},
                               {"triangles_alternating", CellCut::alternating}},
                              std::nullopt, "textures are read so; between its nodes nothing was measured");
    return cut ? trianglesOfGrid(map.numbers.sizePx, *cut) : std::vector<WarpCell>{};
}

}  // namespace

Alignment decideAlignment(const MapFile& map, Decisions& decisions) {
    const glm::ivec2 nodes = map.numbers.sizePx;
    const bool isCoarse = isCoarseGrid(map);
    return decisions.choose<Alignment>(
        "node_alignment", {{"centers", Alignment::centers}, {"corners", Alignment::corners}},
        isCoarse ? Alignment::corners : Alignment::centers,
        fmt::format("{} x {} nodes on {} x {} pixels: {}", nodes.x, nodes.y, map.sizePx.x, map.sizePx.y,
                    isCoarse ? "a grid, whose outermost nodes usually lie on the border"
                             : "nodes are the texels of a texture"));
}

bool decideBottomRowFirst(const MapFile& map, Decisions& decisions) {
    const RowsGuess guess = map.isPfm
                                ? RowsGuess{FileRows::bottomFirst, "PFM files begin with the bottom row"}
                                : RowsGuess{FileRows::topFirst, "pictures begin with the top row"};
    return bottomRowFirst(map, chooseTopFirst(guess, decisions));
}

MapMeaning decideMeaning(const MapFile& map, MapDirection direction, bool isOffset, Decisions& decisions) {
    MapMeaning meaning{.direction = direction, .isOffset = isOffset};
    const bool isForward = direction == MapDirection::forward;
    bool up = false;
    std::string evidence = "0 is the top in MPCDI and in textures of most programs";
    if (isForward || isOffset) {
        up = true;
        evidence = "programs that write where vertices land count upwards, as OpenGL does";
    } else if (map.survey.thirdIsNan) {
        up = true;
        evidence = "the third channel is NaN everywhere, as Evans & Sutherland write it, who count upwards";
    }
    meaning.yUp = decisions.choose<bool>(isForward ? "screen_y" : "source_v", {{"up", true}, {"down", false}},
                                         up, evidence);
    // Programs that count upwards take the first row of a PFM for the top one, against its rule.
    const FileRows usual = map.isPfm && !meaning.yUp ? FileRows::bottomFirst : FileRows::topFirst;
    const bool topFirst = chooseTopFirst(guessRows(map, meaning.yUp, isOffset, usual, decisions), decisions);
    meaning.bottomRowFirst = bottomRowFirst(map, topFirst);
    if (isForward && !isOffset)
        meaning.alignment = decisions.choose<Alignment>(
            "node_alignment", {{"centers", Alignment::centers}, {"corners", Alignment::corners}},
            Alignment::centers, "SGCT puts the nodes of such maps at the centres of their cells");
    else if (isOffset)
        meaning.alignment = decisions.choose<Alignment>(
            "node_alignment", {{"centers", Alignment::centers}, {"corners", Alignment::corners}},
            Alignment::corners, "meshes of offsets have their outermost nodes on the border");
    else
        meaning.alignment = decideAlignment(map, decisions);
    if (isForward)
        meaning.cells =
            decideCells(map.numbers.sizePx, isOffset ? CellCut::firstToLast : CellCut::alternating,
                        "as SGCT cuts the cells of such a map", decisions);
    else if (isCoarseGrid(map))
        meaning.cells = decideInverseCells(map, decisions);
    return meaning;
}

void decideScale(NumberMap& map, Decisions& decisions) {
    if (map.scale == 1) return;
    const bool isFactor = decisions.choose<bool>(
        "scale", {{"ignored", false}, {"factor", true}}, false,
        fmt::format("the PFM's scale is {:g}; programs that read warp maps look at its sign only",
                    map.scale));
    if (!isFactor) return;
    for (float& number : map.values) number = static_cast<float>(number * map.scale);
    map.scale = 1;
}

PointFrame decideFrame(const KnownFrame& known, const MapSurvey& survey, Decisions& decisions) {
    PointFrame frame;
    if (known.unitM) {
        frame.unitM = *known.unitM;
    } else {
        constexpr double kMostM = 100, kMostCm = 1000;
        const double guess = survey.extent <= kMostM ? 1 : survey.extent <= kMostCm ? 0.01 : 0.001;
        frame.unitM =
            decisions.choose<double>("units",
                                     {{"m", 1},
                                      {"dm", 0.1},
                                      {"cm", 0.01},
                                      {"mm", 0.001},
                                      {"in", 0.0254},
                                      {"ft", 0.3048},
                                      {"yd", 0.9144}},
                                     guess, fmt::format("the largest coordinate is {:.4g}", survey.extent));
    }
    if (known.wallFromFile) {
        frame.wallFromFile = *known.wallFromFile;
        return frame;
    }
    enum class Axes { yUpZBack, yUpZAhead, zUpYAhead };
    switch (decisions.choose<Axes>("axes",
                                   {{"x_right_y_up_z_back", Axes::yUpZBack},
                                    {"x_left_y_up_z_ahead", Axes::yUpZAhead},
                                    {"x_right_y_ahead_z_up", Axes::zUpYAhead}},
                                   Axes::yUpZBack, "the file names no axes; OpenGL's are usual")) {
        case Axes::yUpZBack:
            break;
        case Axes::yUpZAhead:
            frame.wallFromFile = glm::dmat3(-1, 0, 0, 0, 1, 0, 0, 0, -1);
            break;
        case Axes::zUpYAhead:
            frame.wallFromFile = glm::dmat3(1, 0, 0, 0, 0, -1, 0, 1, 0);  // by columns
            break;
    }
    return frame;
}

}  // namespace curvewall
