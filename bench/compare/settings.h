#pragma once
// What is compared on one display.

#include "renderer/render.h"

#include <string>
#include <vector>

namespace curvewall {

// Requests that differ from `base` in their method and its settings.
std::vector<RenderRequest> settingsFor(const RenderRequest& base);

// The columns that tell which request it was: method, source, filter, tolerance_px, samples.
std::string settingAsCsv(const RenderRequest& request);

}  // namespace curvewall
