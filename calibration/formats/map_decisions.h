#pragma once
// What map files leave open, decided by their numbers.

#include "calibration/formats/decisions.h"
#include "calibration/formats/map_calibration.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <optional>
#include <string>

namespace curvewall {

// Of a map's valid nodes; programs mark what they did not measure by numbers that are not finite.
struct MapSurvey {
    glm::dvec2 low{0}, high{0}, mean{0};   // of the first two numbers
    double firstRowsY = 0, lastRowsY = 0;  // mean second number in both halves, in the order of the file
    bool hasNodes = false;
    bool thirdIsNan = false;   // nowhere a number
    bool thirdIsZero = false;  // everywhere zero, or there is none
    double extent = 0;         // the largest coordinate of a point
};

MapSurvey surveyMap(const NumberMap& map, bool isPfm);

// Whether the numbers are offsets from where the nodes lie, not positions.
bool looksLikeOffsets(const MapSurvey& survey);

// Whether the numbers are to be multiplied by the scale of a PFM that has another one than 1.
void decideScale(NumberMap& map, Decisions& decisions);

struct MapFile {
    const NumberMap& numbers;
    MapSurvey survey;
    bool isPfm = true;     // whose rows come from the bottom up; NumberMap has turned them
    glm::ivec2 sizePx{0};  // of the display
    std::string name;      // for warnings
};

// Row order, node alignment, the direction of the second number and, of forward maps and of grids that are
// coarser than the display, how cells are filled; of maps that are a forward or an inverse one, of offsets or
// positions.
MapMeaning decideMeaning(const MapFile& map, MapDirection direction, bool isOffset, Decisions& decisions);

bool decideBottomRowFirst(const MapFile& map, Decisions& decisions);  // of points
Alignment decideAlignment(const MapFile& map, Decisions& decisions);

// Where points lie in the wall, as far as the file does not say it.
struct KnownFrame {
    std::optional<double> unitM;
    std::optional<glm::dmat3> wallFromFile;
};
PointFrame decideFrame(const KnownFrame& known, const MapSurvey& survey, Decisions& decisions);

}  // namespace curvewall
