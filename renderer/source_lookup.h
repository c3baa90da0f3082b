#pragma once
// Where the pixels of a display are looked up in the pictures of an image source.

namespace curvewall {

enum class SourceLookup {
    pixel,  // where their exact rays meet the source
    mesh,   // where a deformed mesh has them
};

}  // namespace curvewall
