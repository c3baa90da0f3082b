#pragma once
// How far what a method draws is from the truth, in the three ways that docs/report.md names.

#include "calibration/pieces/certificate.h"
#include "renderer/image_compare.h"
#include "renderer/render.h"

#include <cstdint>

namespace curvewall {

// What exact rays show on one display.
struct Truth {
    Frame color;         // at pixel centres
    Frame position;      // at pixel centres
    Frame coverage;      // at pixel centres: how many surfaces the ray meets
    Frame supersampled;  // colour over whole pixels; empty where nobody asks for it
};

// Of a picture that is off by a fraction of a pixel the borders of things lie elsewhere, which is geometry
// and counted there. So a pixel is at fault only where the truth agrees about it with the eight around it.
struct CoverageError {
    uint64_t uncoveredPixels = 0;     // show nothing, and the truth something at all nine
    uint64_t overdrawnPixels = 0;     // show something, and the truth nothing at all nine
    uint64_t twiceCoveredPixels = 0;  // of more surfaces than the truth has at any of the nine

    uint64_t total() const { return uncoveredPixels + overdrawnPixels + twiceCoveredPixels; }
};

struct MethodErrors {
    Certificate geometric;         // of the points shown: |project(point) - pixel centre|, px
    uint64_t misplacedPixels = 0;  // show what the display has no place for; not in `geometric`
    ImageDifference image;         // from Truth::color
    CoverageError coverage;
    double supersampledPsnrDb = 0;  // against Truth::supersampled; 0 without it
    // Pixels whose colour is no finite number, or whose position is none though they show something and the
    // truth has one at all nine.
    uint64_t nanTexels = 0;
};

// What a method draws of one request; the camera, scene and display are those of the truth.
struct DrawnOutputs {
    Frame color, position, coverage;
    RenderStats stats;  // of the colour
};

// Renders `request` three times, once for each output, with one sample for all but the colour. Throws as
// Renderer::render does.
DrawnOutputs drawOutputs(Renderer& renderer, RenderRequest request);

// Throws UsageError where the pictures are not of one size.
MethodErrors errorsOf(const DrawnOutputs& drawn, const Truth& truth, const Display& display);

}  // namespace curvewall
