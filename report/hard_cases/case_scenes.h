#pragma once
// What scenes of hard cases are built from.

#include "renderer/scene/scene_building.h"

#include <glm/vec3.hpp>

#include <array>
#include <memory>
#include <utility>

namespace curvewall::hard_cases {

inline ScenePtr shared(Scene scene) { return std::make_shared<const Scene>(std::move(scene)); }

// Far enough apart that a pixel of one is no pixel of another.
inline constexpr std::array<glm::vec3, 4> kPaints{glm::vec3(0.85f, 0.35f, 0.05f),
                                                  glm::vec3(0.02f, 0.25f, 0.75f),
                                                  glm::vec3(0.8f, 0.75f, 0.3f), glm::vec3(0.1f, 0.5f, 0.2f)};

inline void startPaint(Scene& scene, size_t paint) {
    startMaterial(scene, plainMaterial(kPaints[paint % kPaints.size()]));
}

// A closed room around everything, so that a hole shows another colour.
inline Scene insideRoom(float sizeM = 20) { return boxRoom(glm::vec3(sizeM)); }

// A room and triangles of many sizes in it, all `scale` times as large as they are in metres. Throws
// UsageError where nothing of it can be drawn.
Scene clutteredRoom(double scale, int triangles = 60);

}  // namespace curvewall::hard_cases
