#pragma once
// One call from a wall, a scene and a method to a picture.

#include "renderer/image_compare.h"
#include "renderer/render.h"

#include <cmath>
#include <memory>
#include <utility>
#include <vector>

namespace curvewall::test {

inline RenderRequest requestFor(Wall wall, Scene scene, Camera camera = {}) {
    RenderRequest request;
    request.wall = std::make_shared<const Wall>(std::move(wall));
    request.scene = std::make_shared<const Scene>(std::move(scene));
    request.camera = camera;
    return request;
}

// The same request by the reference, one ray through each pixel's centre.
inline RenderResult referenceOf(RenderRequest request) {
    request.method = Method::reference;
    return Renderer().render(request);
}

inline ImageDifference differenceFromReference(const RenderRequest& request) {
    return compareColor(Renderer().render(request).frame, referenceOf(request).frame);
}

// The decibels that 1, 4 and 64 samples a pixel are from 256 of the reference. Drivers have four, and not 64.
inline std::vector<double> psnrDbOfMoreSamples(Renderer& renderer, RenderRequest request) {
    request.samples = 256;
    const Frame truth = referenceOf(request).frame;
    std::vector<double> psnrDb;
    for (const int samples : {1, 4, 64}) {
        request.samples = samples;
        psnrDb.push_back(compareColor(renderer.render(request).frame, truth).psnrDb);
    }
    return psnrDb;
}

// Pixels that one picture shows something at and the other does not.
inline int disagreementsOnCover(const Frame& a, const Frame& b) {
    int count = 0;
    for (size_t i = 0; i < a.texels.size(); i += static_cast<size_t>(a.channels))
        count += std::isfinite(a.texels[i]) != std::isfinite(b.texels[i]);
    return count;
}

}  // namespace curvewall::test
