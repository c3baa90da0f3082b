#pragma once
// A scene that rays can be cast into. The only place that knows Embree.

#include "renderer/scene/scene.h"

#include <glm/vec3.hpp>

#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace curvewall {

// In the scene's axes, relative to its origin. The direction has length one.
struct SceneRay {
    glm::dvec3 originM;
    glm::dvec3 direction;
    double nearM = 0;  // hits nearer than this are none
};

struct RayHit {
    uint32_t triangle = 0;
    float distanceM = 0;
    bool onEdge = false;  // as near to an edge of the triangle as float can tell
};

class RayScene {
public:
    using Accept = std::function<bool(const RayHit&)>;

    explicit RayScene(const Scene& scene);
    ~RayScene();
    RayScene(RayScene&&) noexcept;
    RayScene& operator=(RayScene&&) noexcept;

    // The nearest hit that `accept` takes; without one, the nearest. Rays through the edges and vertices of a
    // closed surface hit it.
    std::optional<RayHit> nearestHit(const SceneRay& ray, const Accept& accept) const;

    // Every triangle that the ray meets, in no order. A ray through an edge may meet both its triangles.
    std::vector<RayHit> allHits(const SceneRay& ray) const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace curvewall
