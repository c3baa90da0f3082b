#pragma once
// Warp meshes of domeprojection.com's ProjectionTools: lines "x;y;u;v;column;row" with positions on the
// screen and in the picture as fractions, both from the top left. What the picture shows is not in the file.

#include "calibration/formats/mesh_calibration.h"

namespace curvewall {

bool isDomeprojectionFile(const FileBytes& file);
MeshCalibration readDomeprojectionFile(const FileBytes& file, Decisions& decisions);

}  // namespace curvewall
