#pragma once
// Maps of numbers on a grid, as PFM and EXR files and VIOSO warps hold them: what their numbers mean, and the
// projections that they make.

#include "calibration/files/map_file.h"
#include "calibration/formats/calibration_file.h"
#include "calibration/formats/mesh_calibration.h"
#include "calibration/projections/camera_texture.h"
#include "calibration/projections/grid_layout.h"

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <string>
#include <vector>

namespace curvewall {

// A rectangle of a picture, in fractions of it from the top left corner.
struct PictureRect {
    glm::dvec2 origin{0};
    glm::dvec2 size{1};
};

// What the first two numbers of every node mean: fractions of a picture.
struct MapMeaning {
    // forward: where nodes of the source land on the display; inverse: which position of the source nodes of
    // the display show.
    MapDirection direction = MapDirection::inverse;
    Alignment alignment = Alignment::centers;  // of the nodes
    bool isOffset = false;                     // the numbers are relative to the node's own place
    bool bottomRowFirst = false;               // row 0 of the numbers lies at the bottom
    bool yUp = false;                          // the second number grows upwards
    PictureRect sourceRect{};                  // the part of the source that the map speaks of
    // From the top row of nodes down. A forward map needs them; an inverse map with cells is drawn as a mesh
    // of its nodes and reaches only from the first to the last of them, and one without is bilinear.
    std::vector<WarpCell> cells{};
};

// Projection of a display of `sizePx` with the map, onto what `source` shows. Nodes that are not finite and
// those at (-1, -1), as some programs mark what they did not measure, are holes. Throws InputError, with
// `path`, for a map of less than 2 x 2 nodes or two channels or without area, and for one with cells of more
// than four million nodes.
ProjectionPtr projectionOfMap(const NumberMap& map, const MapMeaning& meaning, glm::ivec2 sizePx,
                              const SourcePicture& source, const std::string& path);

// A map with cells as a mesh. Throws in the same way.
MeshCalibration meshOfMap(const NumberMap& map, const MapMeaning& meaning, const std::string& path);

// Where points of a file lie in the wall: rotation (or mirroring) first.
struct PointFrame {
    glm::dmat3 wallFromFile{1};
    double unitM = 1;
    glm::dvec3 originM{0};
};

// A measured surface: the points that the nodes light. Points with a number that is not finite and those
// within 1e-5 of the origin are holes. Throws in the same way.
ProjectionPtr projectionOfSurface(const NumberMap& points, const PointFrame& frame, bool bottomRowFirst,
                                  Alignment alignment, glm::ivec2 sizePx, glm::dvec3 eyeM,
                                  const std::string& path);

}  // namespace curvewall
