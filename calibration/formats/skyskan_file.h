#pragma once
// Warp meshes of Sky-Skan as text (.skyskan, .txt): lines "Dome Azimuth=", "Dome Elevation=", "Horizontal
// FOV=" and the like in degrees, the columns and rows, and "x y u v" for every node, all fractions from the
// top left.
//
// No description and no sample of the format is public; what SGCT reads (src/correction/skyskan.cpp) is.

#include "calibration/formats/mesh_calibration.h"

namespace curvewall {

bool isSkyskanFile(const FileBytes& file);
MeshCalibration readSkyskanFile(const FileBytes& file, Decisions& decisions);

}  // namespace curvewall
