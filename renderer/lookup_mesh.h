#pragma once
// How a display looks its source up where it is drawn as a deformed mesh: a grid of cells whose corners know
// their places exactly, and linear between them.

#include "renderer/image_source.h"

#include <array>
#include <vector>

namespace curvewall {

// Two triangles, with the diagonal from the top right to the bottom left corner.
struct LookupCell {
    glm::ivec2 fromPx, toPx;  // corners of pixels
    std::array<glm::dvec2, 4>
        places{};  // of the corners in texels: top left, top right, bottom left, bottom right
    int face = 0;
};

// Cells of `stepPx` pixels, smaller at the display's right and lower border. A cell that sees several faces,
// or holes, is halved until it does not; one of a single pixel is exact at its centre.
std::vector<LookupCell> lookupMesh(const ImageSource& source, const PixelRays& rays,
                                   const Projection& projection, int stepPx);

// As sourcePlaces gives them, but what the mesh makes of them.
std::vector<glm::vec4> meshPlaces(const std::vector<LookupCell>& mesh, glm::ivec2 sizePx);

}  // namespace curvewall
