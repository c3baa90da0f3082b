#pragma once
// Warp meshes of Barco's SimCAD projectors: XML with a square grid of offsets in pixels, rows from the top,
// of where the positions of an evenly divided picture land. What the picture shows is not in the file.

#include "calibration/formats/mesh_calibration.h"

namespace curvewall {

bool isSimcadFile(const FileBytes& file);
MeshCalibration readSimcadFile(const FileBytes& file, Decisions& decisions);

}  // namespace curvewall
