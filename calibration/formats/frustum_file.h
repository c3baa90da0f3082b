#pragma once
// What the picture of a warp mesh shows, in a file of its own beside it: two lines of CSV as
// domeprojection.com's ProjectionTools write them, names and then values. Angles are degrees; heading turns
// right, pitch up, bank clockwise.

#include "calibration/files/file_bytes.h"
#include "calibration/formats/decisions.h"
#include "calibration/projections/frustum.h"

#include <optional>

namespace curvewall {

// The frustum beside "STEM_mesh.csv" or "STEM.simcad" is "STEM_frustum.csv". Nothing where there is none.
std::optional<Frustum> frustumBeside(const FileBytes& mesh, const FindFile& find, Decisions& decisions);

// By its first line.
bool isFrustumFile(const FileBytes& file);

Frustum readFrustumFile(const FileBytes& file, Decisions& decisions);

}  // namespace curvewall
