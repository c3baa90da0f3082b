#pragma once
// One perspective picture that just holds what a display shows, as tools without a cube map make it.

#include "renderer/image_source.h"

namespace curvewall {

// The picture's longer side is `faceSizePx`; 0 takes one texel for one pixel where the display is densest,
// kMostFacePx of request_limits.h at most. Its axes are those that need the fewest texels for that. Throws
// UsageError where the display shows more than a plane can hold.
ImageSource planarSource(const PixelRays& rays, int faceSizePx);

}  // namespace curvewall
