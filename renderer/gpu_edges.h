#pragma once
// What lies across the edges of a scene's triangles, in GPU memory, for the styles that draw edges.

#include "renderer/gpu_scene.h"

namespace curvewall {

// Fills every chunk's `across` where that has not happened yet.
void uploadEdges(GpuScene& scene);

}  // namespace curvewall
