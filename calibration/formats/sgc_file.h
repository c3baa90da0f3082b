#pragma once
// Warp meshes of SCISS (now Zeiss) in their binary form, .sgc, with the frustum of the picture they bend.
//
// Little-endian: "SGC", a byte of version, a word of type, the quaternion x y z w, the position x y z, the
// angles up down left right in degrees (right and up positive), two words of size, the vertices
// {x y z u v w} with x right and y down and u right and v up, a word of count, the indices of a triangle
// strip. In version 1 the sizes are the columns and rows of a grid; in version 2 the second is the number of
// vertices, and 4 as the first says that the indices are single triangles.

#include "calibration/formats/mesh_calibration.h"

namespace curvewall {

bool isSgcFile(const FileBytes& file);
MeshCalibration readSgcFile(const FileBytes& file, Decisions& decisions);

}  // namespace curvewall
