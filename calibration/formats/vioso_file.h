#pragma once
// VIOSO warp files (.vwf).

#include "calibration/formats/calibration_file.h"

namespace curvewall {

bool isViosoFile(const FileBytes& file);

// A display for every warp, named as the file names it, seen as VIOSOWarpBlend.ini says if that is beside the
// file and names it. Throws like readCalibration.
Wall readViosoFile(const FileBytes& file, const FindFile& find, const CalibrationRequest& request,
                   Decisions& decisions);

}  // namespace curvewall
