#pragma once
// Files of warp meshes, whatever program wrote them.

#include "calibration/formats/mesh_calibration.h"

namespace curvewall {

// Whether a mesh lies in the file: by its content, and by its extension only where content cannot tell.
bool isMeshFile(const FileBytes& file);

// Reads it by the reader of its format. Throws like readCalibration. Formats that tell nothing of their
// source have it in a file beside them; without a `find` nothing is looked for, and nothing decided about it.
MeshCalibration readMesh(const FileBytes& file, const FindFile& find, Decisions& decisions);

}  // namespace curvewall
