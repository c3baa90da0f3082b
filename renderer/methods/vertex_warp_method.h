#pragma once
// A request to the vertex-warp method.

#include "renderer/methods/raster_resources.h"

#include <memory>

namespace curvewall {

class VertexWarpMethod {
public:
    explicit VertexWarpMethod(RasterResources& resources) : resources_(resources) {}

    // Throws UsageError for what cannot be done: displays that show a direction at several places or tear
    // their picture, scenes with points or lines.
    RenderResult render(const RenderRequest& request, const Display& display);

private:
    struct DisplayKey {
        WallPtr wall;
        const Display* display;  // of that wall
        bool operator==(const DisplayKey&) const = default;
    };
    struct PreparedDisplay {
        std::shared_ptr<const GpuScreenMap> map;
        std::shared_ptr<const GpuOwners> owners;
    };
    struct WarpKey {
        std::shared_ptr<const PreparedDisplay> display;
        double tessellationPx;
        bool operator==(const WarpKey&) const = default;
    };

    std::shared_ptr<const GpuWarp> preparedWarp(const RenderRequest& request, const Display& display);

    GeometricError measuredError(const RenderRequest& request, const Display& display);

    RasterResources& resources_;
    RecentlyUsed<DisplayKey, const PreparedDisplay> displays_{16};
    RecentlyUsed<WarpKey, const GpuWarp> warps_{16};
};

}  // namespace curvewall
