#include "report/flat_scene.h"

#include "renderer/image_file.h"

namespace curvewall {
namespace {

glm::vec3 averageOf(const Texture& texture) {
    const glm::u8vec4 texel = texture.levels.back().texels.front();
    return {linearFromSrgbByte(texel.r), linearFromSrgbByte(texel.g), linearFromSrgbByte(texel.b)};
}

}  // namespace

ScenePtr flatScene(Scene scene) {
    for (Material& material : scene.materials) {
        if (material.texture < 0) continue;
        const glm::vec3 average = averageOf(scene.textures[static_cast<size_t>(material.texture)]);
        material.baseColor *= glm::vec4(average, 1);
        material.texture = -1;
        material.alphaCutoff = -1;
    }
    scene.textures.clear();
    return std::make_shared<const Scene>(std::move(scene));
}

RenderRequest inFlatColors(RenderRequest request, const ScenePtr& flat) {
    request.scene = flat;
    request.style = Style::unlit;
    request.frames = 1;
    request.timesStages = false;
    return request;
}

}  // namespace curvewall
