#pragma once
// A request to the bounded-raycast method.

#include "renderer/bounded_raycast.h"
#include "renderer/methods/raster_resources.h"

#include <memory>

namespace curvewall {

class BoundedRaycastMethod {
public:
    explicit BoundedRaycastMethod(RasterResources& resources) : resources_(resources) {}

    // Throws UsageError for what cannot be done.
    RenderResult render(const RenderRequest& request, const Display& display);

private:
    struct RaysKey {
        RoundLens lens;
        int samples;
        bool operator==(const RaysKey&) const = default;
    };

    std::shared_ptr<LensRays> raysFor(const RoundLens& lens, int samples);
    uint64_t countFragments(const RenderRequest& request, PreparedScene& scene, const RoundLens& lens,
                            BoundedPath::Fragments fragments);
    Certificate measureError(const RenderRequest& request, const Display& display, PreparedScene& scene,
                             const RoundLens& lens);

    RasterResources& resources_;
    RecentlyUsed<RaysKey, LensRays> rays_{2};  // large
};

}  // namespace curvewall
