#pragma once

namespace curvewall {

// What bounded-raycast draws around what a display shows of a triangle.
enum class BoundingShape {
    triangle,     // up to four triangles, tight
    quad,         // one rectangle, the least of those along the axes and along its sides
    genericQuad,  // one rectangle along the axes, for which only radii and azimuths are asked
};

}  // namespace curvewall
