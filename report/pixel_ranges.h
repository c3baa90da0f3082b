#pragma once
// What a picture has within a pixel of each place, so that what is off by a fraction of a pixel is no error.

#include "renderer/frame.h"

#include <vector>

namespace curvewall {

struct Range {
    float least, most;
};

// Of every number of the frame, over its pixel and the eight around. `isClosed`: the left border goes on at
// the right one.
std::vector<Range> rangesAround(const Frame& frame, bool isClosed);

}  // namespace curvewall
