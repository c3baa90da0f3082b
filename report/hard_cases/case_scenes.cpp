#include "report/hard_cases/case_scenes.h"

#include "calibration/errors.h"
#include "renderer/scene/random.h"
#include "renderer/scene/scene_builder.h"

#include <vector>

namespace curvewall::hard_cases {

namespace {

// As a file's scene would be after loading: what cannot be drawn is left out.
Scene loaded(const Scene& made, double scale) {
    Scene scene;
    std::vector<MeshPart> parts;
    for (const MaterialRange& range : made.ranges) {
        MeshPart& part = parts.emplace_back();
        part.material = static_cast<uint32_t>(scene.materials.size());
        scene.materials.push_back(made.materials[range.material]);
        for (uint32_t i = 0; i < 3 * range.triangleCount; ++i) {
            const glm::uvec3 triangle = made.triangles[range.firstTriangle + i / 3];
            part.positionsM.push_back(scale * glm::dvec3(made.positions[triangle[static_cast<int>(i % 3)]]));
            if (i % 3 == 0) part.triangles.emplace_back(i, i + 1, i + 2);
        }
    }
    setGeometry(scene, parts);
    if (isEmpty(scene)) throw UsageError("the scene has nothing to draw: " + scene.notes.front());
    return scene;
}

}  // namespace

Scene clutteredRoom(double scale, int triangles) {
    Scene scene = boxRoom(glm::vec3(8));
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
        addTriangle(scene, {centre + inBox(size), centre + inBox(size), centre + inBox(size)});
    }
    return loaded(scene, scale);
}

}  // namespace curvewall::hard_cases
