#pragma once
// What stays wrong where the projection is exact: by the samples, and by how the rasterizer filters textures.

#include "report/truth.h"

#include <optional>
#include <vector>

namespace curvewall {

// Small flat windows, each a plain perspective picture of what the display of `view` shows around one of its
// pixels, as large as there. One piece serves such a window, so that nothing of its picture is approximated.
// Those of pixels without a ray are left out.
std::vector<RenderRequest> flatWindows(const RenderRequest& view);

// Over all windows, for pictures of so many samples a pixel. `flat` is their scene in flat colours.
// Nothing where there are no windows.
std::optional<SamplingFloor> samplingFloor(Renderer& renderer, const std::vector<RenderRequest>& windows,
                                           const std::vector<KnownTruth>& truths, const ScenePtr& flat,
                                           int samples);

}  // namespace curvewall
