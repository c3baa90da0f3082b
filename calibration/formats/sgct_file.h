#pragma once
// Configurations of SGCT (github.com/sgct/sgct) as a wall: a display for each viewport that shows something.

#include "calibration/formats/calibration_file.h"

namespace curvewall {

bool isSgctFile(const FileBytes& file);

// With `request.display` only that display's meshes and masks are looked for.
Wall readSgctFile(const FileBytes& file, const FindFile& find, const CalibrationRequest& request,
                  Decisions& decisions);

}  // namespace curvewall
