#pragma once
// Warp meshes of Scalable Display Technologies as text, .ol ("OPENMESH Version 1.1"): lines of keys with
// values, vertices "x y intensity s t" in native pixels and 0 to 255, and faces "[ a b c ]".
//
// No description and no sample of the format is public; what SGCT reads (src/correction/scalable.cpp) is.

#include "calibration/formats/mesh_calibration.h"

namespace curvewall {

bool isOpenmeshFile(const FileBytes& file);
MeshCalibration readOpenmeshFile(const FileBytes& file, Decisions& decisions);

}  // namespace curvewall
