#pragma once
// How the eye sees a scene in one frame, in the single precision of the shaders.

#include "renderer/camera.h"
#include "renderer/scene/scene.h"

#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

namespace curvewall {

// ray = wallFromScene * (position + originFromEyeM), position relative to the scene's origin.
struct SceneView {
    glm::mat3 wallFromScene;
    glm::vec3 originFromEyeM;  // scene axes
};

// The eye is subtracted in double before anything becomes float. `pictureFromWall`
// turns the view to other axes than the wall's.
inline SceneView sceneViewOf(const Camera& camera, glm::dvec3 eyeInWallM, const Scene& scene,
                             const glm::dmat3& pictureFromWall = glm::dmat3(1)) {
    return {glm::mat3(pictureFromWall * glm::transpose(rotationFromOrientation(camera.orientation))),
            glm::vec3(scene.originM - eyeInScene(camera, eyeInWallM))};
}

}  // namespace curvewall
