#pragma once
// A scene in GPU memory.

#include "renderer/gl/gl_objects.h"
#include "renderer/meshlets.h"
#include "renderer/scene/scene.h"

#include <glm/vec4.hpp>

#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

namespace curvewall {

// A run of a chunk's triangles that share a material, in whole meshlets.
struct ChunkRange {
    uint32_t material = 0;
    uint32_t firstTriangle = 0, triangleCount = 0;
    uint32_t firstMeshlet = 0, meshletCount = 0;
    bool isSingleSided = false;
};

// As shaders/meshlet.glsl reads it; see Meshlet.
struct GpuMeshlet {
    glm::vec4 sphere{0};  // centre relative to the scene's origin, radius
    glm::vec4 cone{0, 0, 1, std::numeric_limits<float>::max()};  // axis and reach
    uint32_t firstTriangle = 0;
    uint32_t triangleCount = 0;
    uint32_t isSingleSided = 0;
    float coneSine = 0;
    float coneCosine = 1;
    uint32_t reserved[3]{};
};

// A part of a scene whose buffers stay below the smallest storage block limit in use (128 MB on llvmpipe).
struct SceneChunk {
    GlBuffer positions;  // three floats a vertex, metres relative to the scene's origin
    GlBuffer normals;    // signed 10-bit integers, x lowest
    GlBuffer uvs;
    GlBuffer corners;   // three vertex indices a triangle, meshlet by meshlet
    GlBuffer meshlets;  // GpuMeshlet
    GlBuffer across;    // what lies beyond each triangle's edges; see gpu_edges.h
    GlVertexArray vertexArray;
    uint32_t triangleCount = 0;
    uint32_t meshletCount = 0;
    std::vector<ChunkRange> ranges;
    std::vector<Meshlet> meshletBounds;  // for the CPU; none of a chunk that changes
    bool changes = false;                // ranges and meshlets are other ones in every frame
};

// Positions, normals and uvs as vertex attributes 0 to 2, corners as indices.
GlVertexArray vertexArrayOver(const SceneChunk& chunk);

class BlendedTriangles;
struct StrokeScene;

struct GpuScene {
    ScenePtr scene;
    std::vector<SceneChunk> chunks;             // of what hides what lies behind it
    std::shared_ptr<BlendedTriangles> blended;  // of the rest, where there is any
    std::shared_ptr<StrokeScene> strokes;       // points and lines, where there are any
    std::vector<GlTexture> textures;
    std::vector<GlSampler> samplers;  // one a texture
};

// For what is drawn from now on; at most what the driver has, and nothing where it has none.
void setAnisotropy(const GpuScene& scene, int anisotropy);

uint64_t meshletCountOf(const GpuScene& scene);
size_t memoryBytesOf(const GpuScene& scene);  // with textures, and what finds the pieces of strokes

enum class TriangleOrder {
    byMeshlets,  // within a material, those that lie close together follow each other
    asGiven,
};

// Throws UsageError when a texture is larger than the driver allows, or when too many triangles blend.
GpuScene uploadScene(ScenePtr scene, TriangleOrder order = TriangleOrder::byMeshlets);

}  // namespace curvewall
