#pragma once
// What a scene asks of any method that draws it on a display, seen from one place.

#include "renderer/display_facts.h"
#include "renderer/scene/scene.h"
#include "renderer/scene_view.h"

namespace curvewall {

// Lengths and areas are those of mean pixels: a display's solid angle over its pixels.
struct SceneFacts {
    double triangles = 0;
    double seenTriangles = 0;    // at least partly in the cone that the display sees
    double fragmentsAPixel = 0;  // of theirs, were none hidden
    double longestEdgePx = 0;    // of a triangle that is seen
    double squaredEdgesPx2 = 0;  // the sum over triangles that are seen of the square of their longest edge
};

// Looks at every triangle of a scene of up to 200,000, and at so many of a larger one.
SceneFacts factsOf(const Scene& scene, const SceneView& view, const DisplayFacts& display);

}  // namespace curvewall
