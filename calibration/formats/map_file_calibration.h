#pragma once
// A PFM or EXR map on its own: points of a surface, positions that pixels show, or positions where nodes
// land.

#include "calibration/formats/calibration_file.h"

namespace curvewall {

bool isMapFile(const FileBytes& file);

// One display, named after the file. Throws like readCalibration.
Wall readMapFile(const FileBytes& file, const FindFile& find, const CalibrationRequest& request,
                 Decisions& decisions);

}  // namespace curvewall
