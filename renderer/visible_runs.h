#pragma once
// The triangles of a scene that a plain draw has to look at: without the meshlets that lie beside the picture
// or are seen from behind.

#include "renderer/replicator.h"
#include "renderer/triangle_runs.h"

#include <functional>

namespace curvewall {

class VisibleRuns {
public:
    // Whether a sphere may reach into the picture; its centre is relative to the eye, in the axes of the
    // view.
    using SphereTest = std::function<bool(glm::vec3 centre, float radius)>;

    explicit VisibleRuns(SphereTest reachesIn) : reachesIn_(std::move(reachesIn)) {}

    void beginPass() { found_ = {}; }

    const TriangleRuns& find(const SceneChunk& chunk, const ChunkRange& range, const SceneView& view);

    // Triangles and meshlets since the pass began.
    const FrameOutcome& found() const { return found_; }

private:
    bool isSeen(const Meshlet& meshlet, bool isSingleSided, const SceneView& view) const;
    void add(uint32_t firstTriangle, uint32_t triangleCount);

    SphereTest reachesIn_;
    TriangleRuns runs_;
    FrameOutcome found_;
};

}  // namespace curvewall
