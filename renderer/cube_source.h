#pragma once
// Faces of a cube around the eye, turned to what a display shows and each only as large as the display sees
// of it.

#include "renderer/image_source.h"

namespace curvewall {

// Faces with `faceSizePx` texels along 90 degrees. 0 takes one texel for one pixel where the display is
// densest, rounded up to a multiple of 16 and kept within kLeastFacePx and kMostAutomaticFacePx of
// request_limits.h.
//
// The cube stands along the wall's axes or looks along the display's axis: squarely, rolled by 45 degrees,
// or with an edge ahead, as SGCT's four faces do for a dome. The first that needs the fewest texels is taken.
ImageSource cubeSource(const PixelRays& rays, int faceSizePx);

// A whole face ahead and the halves of four beside it. Ahead is the mean direction of the display's pixels,
// or where that leaves some of them behind, the axis of the narrowest cone around them. Throws UsageError
// where a ray is more than 90 degrees (and a twentieth, for rounding) from both.
ImageSource hemicubeSource(const PixelRays& rays, int faceSizePx);

}  // namespace curvewall
