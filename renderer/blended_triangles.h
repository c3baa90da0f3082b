#pragma once
// Triangles that mix with what lies behind them: drawn after all others, far to near, each pixel by its owner
// alone.

#include "renderer/gpu_scene.h"
#include "renderer/scene_view.h"

#include <optional>
#include <vector>

namespace curvewall {

class BlendedTriangles {
public:
    struct Triangle {
        glm::uvec3 corners;  // vertices of the chunk
        glm::vec3 centre;    // relative to the scene's origin
        uint32_t material = 0;
        bool isSingleSided = false;
    };

    // One chunk, whose vertices are there already and whose triangles come with every order.
    BlendedTriangles(SceneChunk chunk, std::vector<Triangle> triangles);

    // Puts them in order of their centres' distance from the eye, once for all pieces. Triangles that pierce
    // each other or overlap in a ring have no right order.
    void sortFor(const SceneView& view);

    const SceneChunk& chunk() const { return chunk_; }

    // Unsorted, as they came.
    std::vector<glm::uvec3> corners() const;
    // What lies across the three edges of each, unsorted; see gpu_edges.h. It is sorted with them from then
    // on.
    void setAcross(std::vector<uint32_t> across);

private:
    void upload();

    struct Key {
        float squaredDistance;
        uint32_t triangle;
    };
    SceneChunk chunk_;
    std::vector<Triangle> triangles_;
    std::optional<glm::vec3> sortedFor_;  // where the eye was
    std::vector<Key> keys_;
    std::vector<glm::uvec3> corners_;
    std::vector<GpuMeshlet> meshlets_;
    std::vector<uint32_t> across_, sortedAcross_;  // empty where no style has asked
};

}  // namespace curvewall
