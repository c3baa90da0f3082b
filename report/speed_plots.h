#pragma once
// Time against each of the errors, of one view.

#include "report/document.h"
#include "report/speed_report.h"

#include <string>
#include <vector>

namespace curvewall {

// Against the geometric error, that of wrong edges where it is known, the share of wrong pixels, and the
// PSNR against the supersampled truth. Of many curves they show those nearest to the front, and of each
// method one at least. Captions name what an axis has no place for; where that is everything a sentence after
// the plots stands for the plot. Files begin with `stem`.
std::vector<Block> speedPlots(const ViewReport& view, double tolerancePx, const std::string& stem);

}  // namespace curvewall
