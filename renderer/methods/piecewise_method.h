#pragma once
// Pieces fitted, scene prepared, frames measured: a request to the piecewise method.

#include "renderer/methods/raster_resources.h"

#include <memory>

namespace curvewall {

class PiecewiseMethod {
public:
    explicit PiecewiseMethod(RasterResources& resources) : resources_(resources) {}

    // Throws UsageError for what cannot be done.
    RenderResult render(const RenderRequest& request, const Display& display);

    // Those that came with the request, or fitted now and kept.
    std::shared_ptr<const FittedPieces> piecesFor(const RenderRequest& request, const Display& display) {
        return preparedPieces(request, display)->fitted;
    }

private:
    struct PiecesKey {
        WallPtr wall;
        const Display* display;  // of that wall
        double tolerancePx;
        std::shared_ptr<const FittedPieces> pieces;  // those that came with the request
        bool operator==(const PiecesKey&) const = default;
    };
    struct SampledDrawKey {
        std::shared_ptr<PreparedScene> scene;
        DrawKey draw;
        bool operator==(const SampledDrawKey&) const = default;
    };
    struct OwnersKey {
        OwnersPtr owners;
        int samples;
        bool operator==(const OwnersKey&) const = default;
    };

    std::shared_ptr<PreparedPieces> preparedPieces(const RenderRequest& request, const Display& display);
    std::shared_ptr<const GpuOwners> sampleOwnersFor(const PreparedScene& scene,
                                                     const PreparedPieces& prepared,
                                                     const SampledTarget& target, int samples);
    std::shared_ptr<PreparedDraw> preparedDraw(const RenderRequest& request,
                                               const std::shared_ptr<PreparedScene>& scene,
                                               const std::shared_ptr<PreparedPieces>& prepared,
                                               const SampledTarget& target, int samples);

    RasterResources& resources_;
    RecentlyUsed<PiecesKey, PreparedPieces> pieces_{16};
    RecentlyUsed<OwnersPtr, const GpuOwners> owners_{16};
    RecentlyUsed<OwnersKey, const GpuOwners> sampleOwners_{2};
    RecentlyUsed<SampledDrawKey, PreparedDraw> sampledDraws_{2};
};

}  // namespace curvewall
