#pragma once
// Makes a material current: its program, its texture, and how it mixes with what lies behind it.

#include "renderer/gpu_scene.h"
#include "renderer/scene_programs.h"

namespace curvewall {

struct MaterialBinder {
    const GpuScene& scene;
    const ScenePrograms& programs;

    // The program, which is current then.
    GLuint bind(uint32_t material) const;

    // Makes a chunk what plain vertices come from, or what corners are pulled from.
    void bindVertices(const SceneChunk& chunk) const;
    void bindPulled(const SceneChunk& chunk) const;
};

}  // namespace curvewall
