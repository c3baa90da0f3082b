#pragma once
// A scene in GPU memory.

#include "renderer/gl/gl_objects.h"
#include "renderer/scene/scene.h"

#include <cstdint>
#include <vector>

namespace curvewall {

// A part of a scene whose buffers stay below the smallest storage block limit in use (128 MB on llvmpipe).
struct SceneChunk {
    GlBuffer positions;  // three floats a vertex, metres relative to the scene's origin
    GlBuffer normals;    // signed 10-bit integers, x lowest
    GlBuffer uvs;
    GlBuffer corners;      // three vertex indices a triangle
    GlBuffer singleSided;  // one bit a triangle
    GlBuffer across;       // what lies beyond each triangle's edges; see gpu_edges.h
    GlVertexArray vertexArray;
    uint32_t triangleCount = 0;
    std::vector<MaterialRange> ranges;
};

struct GpuScene {
    ScenePtr scene;
    std::vector<SceneChunk> chunks;
    std::vector<GlTexture> textures;
    std::vector<GlSampler> samplers;  // one a texture
};

// Throws UsageError when a texture is larger than the driver allows.
GpuScene uploadScene(ScenePtr scene);

}  // namespace curvewall
