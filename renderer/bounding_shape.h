#pragma once

namespace curvewall {

// What bounded-raycast draws around what a display shows of a triangle.
enum class BoundingShape {
    triangle,  // up to four triangles, tight
    quad,      // one quad: less to compute, more pixels to look at
};

}  // namespace curvewall
