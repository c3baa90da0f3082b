#include "report/hard_cases/case_scenes.h"

#include "renderer/scene/random.h"

namespace curvewall::hard_cases {

Scene clutteredRoom(float scale, int triangles) {
    Scene scene = boxRoom(glm::vec3(8 * scale));
    Random random(8);
    const auto inBox = [&](float half) {
        return glm::vec3(random.between(-half, half), random.between(-half, half),
                         random.between(-half, half));
    };
    for (int i = 0; i < triangles; ++i) {
        startPaint(scene, static_cast<size_t>(i));
        glm::vec3 centre = inBox(3);
        while (glm::length(centre) < 1.5f) centre = inBox(3);
        const float size = 0.6f / static_cast<float>(1 + i % 5);
        addTriangle(scene, {scale * (centre + inBox(size)), scale * (centre + inBox(size)),
                            scale * (centre + inBox(size))});
    }
    return scene;
}

}  // namespace curvewall::hard_cases
