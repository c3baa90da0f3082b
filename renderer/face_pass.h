#pragma once
// How the pictures of an image source are drawn.

namespace curvewall {

enum class FacePass {
    separate,  // one after the other
    layered,   // all at once, each triangle into the layers that it touches
};

}  // namespace curvewall
