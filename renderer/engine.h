#pragma once
// How piecewise rendering gets a triangle into every piece that it touches.

namespace curvewall {

enum class Engine {
    compute,       // compute shaders find the pairs, one indirect draw a material
    geometry,      // geometry shaders and transform feedback find them in three passes
    tessellation,  // one pass: the tessellator multiplies, the geometry shader places
    loop,          // the whole scene once a piece
};

}  // namespace curvewall
