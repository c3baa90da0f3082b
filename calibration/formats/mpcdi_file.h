#pragma once
// MPCDI calibrations (VESA, 1.0 and 2.0): archives, and manifests on their own.

#include "calibration/formats/calibration_file.h"

namespace curvewall {

// A ZIP archive, or XML whose root is MPCDI.
bool isMpcdi(const FileBytes& file);

// A display for every region, named after it, and after its buffer as well where regions share a name.
// Throws like readCalibration.
Wall readMpcdi(const FileBytes& file, const FindFile& find, const CalibrationRequest& request,
               Decisions& decisions);

}  // namespace curvewall
