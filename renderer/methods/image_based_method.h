#pragma once
// A request to the image-based method.

#include "renderer/methods/raster_resources.h"
#include "renderer/prepared_images.h"

namespace curvewall {

class ImageBasedMethod {
public:
    explicit ImageBasedMethod(RasterResources& resources) : resources_(resources) {}

    // Throws UsageError for what cannot be done.
    RenderResult render(const RenderRequest& request, const Display& display);

private:
    RasterResources& resources_;
    PreparedImages images_;
};

}  // namespace curvewall
