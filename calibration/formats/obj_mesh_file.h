#pragma once
// Warp meshes as Wavefront OBJ: vertices are positions on the screen, texture coordinates positions in the
// picture from its bottom left. What the picture shows is not in the file.

#include "calibration/formats/mesh_calibration.h"

namespace curvewall {

bool isObjMeshFile(const FileBytes& file);
MeshCalibration readObjMeshFile(const FileBytes& file, Decisions& decisions);

}  // namespace curvewall
