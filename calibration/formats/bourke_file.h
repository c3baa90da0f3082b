#pragma once
// Warp meshes of Paul Bourke (http://paulbourke.net/dataformats/meshwarp): text with the type, the columns
// and rows, and "x y u v i" for every node, the bottom row first. x runs from -aspect to aspect and y from -1
// to 1, upwards; u and v are fractions of a fisheye picture from its bottom left; the picture is multiplied
// by i.

#include "calibration/formats/mesh_calibration.h"

namespace curvewall {

bool isBourkeFile(const FileBytes& file);
MeshCalibration readBourkeFile(const FileBytes& file, Decisions& decisions);

}  // namespace curvewall
