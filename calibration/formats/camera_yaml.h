#pragma once
// Cameras and projectors in YAML, as cv::FileStorage and ROS write them.

#include "calibration/files/file_bytes.h"
#include "calibration/formats/calibration_file.h"
#include "calibration/formats/decisions.h"
#include "calibration/wall.h"

namespace curvewall {

bool isCameraYaml(const FileBytes& file);

// A display for each camera or projector of the file. Throws like readCalibration.
Wall readCameraYaml(const FileBytes& file, const FindFile& find, const CalibrationRequest& request,
                    Decisions& decisions);

}  // namespace curvewall
