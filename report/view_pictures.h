#pragma once
// The pictures of a report: what methods show at the place where they differ most, and their error by pixel.

#include "report/errors.h"
#include "report/speed_report.h"

#include <string>

namespace curvewall {

// Writes the whole picture and the map of its geometric error into `folder`/pictures, in files that begin
// with `stem`, and names them in the result.
void writePictures(SettingResult& result, const DrawnOutputs& drawn, const Display& display,
                   double tolerancePx, const std::string& folder, const std::string& stem);

// Finds the place where the pictures written differ most from the truth, and cuts it out of each and of the
// truth, enlarged, into the same folder.
void cropPictures(ViewReport& view, const Truth& truth, const std::string& folder, const std::string& stem);

}  // namespace curvewall
