#pragma once
// What the shaders that include piece_coverage.glsl read.

#include "renderer/gpu_pieces.h"
#include "renderer/gpu_scene.h"
#include "renderer/scene_view.h"

namespace curvewall {

void bindForCoverage(const SceneChunk& chunk, const GpuPieces& pieces);
void setForCoverage(GLuint program, const GpuPieces& pieces, glm::vec4 sampleGrid);

// Of scene_geometry.glsl.
void setView(GLuint program, const SceneView& view);

}  // namespace curvewall
