#include "report/content_key.h"

#include "calibration/pieces/pixel_rays.h"
#include "report/machine.h"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>

namespace curvewall {
namespace {

template <class T>
void addAll(ContentKey& key, const std::vector<T>& values) {
    key.add(std::span<const T>(values));
}

// Value by value where structures have padding, whose bytes may be anything.
void addMaterial(ContentKey& key, const Material& material) {
    for (int channel = 0; channel < 4; ++channel) key.addNumber(material.baseColor[channel]);
    key.addNumber(material.texture);
    key.addNumber(material.alphaCutoff);
    key.addNumber(static_cast<int>(material.blending));
    key.addNumber(material.doubleSided);
    key.addNumber(material.unlit);
}

void addTexture(ContentKey& key, const Texture& texture) {
    key.addNumber(static_cast<int>(texture.wrapS));
    key.addNumber(static_cast<int>(texture.wrapT));
    for (const MipLevel& level : texture.levels) {
        key.addNumber(level.sizePx.x);
        addAll(key, level.texels);
    }
}

void addVector(ContentKey& key, glm::dvec3 v) {
    for (int axis = 0; axis < 3; ++axis) key.addNumber(v[axis]);
}

void addScene(ContentKey& key, const Scene& scene) {
    addVector(key, scene.originM);
    addAll(key, scene.positions);
    addAll(key, scene.normals);
    addAll(key, scene.uvs);
    addAll(key, scene.triangles);
    addAll(key, scene.ranges);
    addAll(key, scene.points);
    addAll(key, scene.lines);
    addAll(key, scene.pointRanges);
    addAll(key, scene.lineRanges);
    for (const Material& material : scene.materials) addMaterial(key, material);
    for (const Texture& texture : scene.textures) addTexture(key, texture);
}

void addDisplay(ContentKey& key, const Display& display) {
    key.add(display.name);
    key.addNumber(display.sizePx.x);
    key.addNumber(display.sizePx.y);
    for (int y = 0; y < display.sizePx.y; ++y)
        for (int x = 0; x < display.sizePx.x; ++x)
            addVector(key, display.projection->unproject({x + 0.5, y + 0.5})
                               .value_or(glm::dvec3(std::numeric_limits<double>::infinity())));
    if (!display.blend) return;
    addAll(key, display.blend->alpha);
    addAll(key, display.blend->beta);
}

}  // namespace

void ContentKey::add(std::string_view text) { add(std::span<const char>(text.data(), text.size())); }

std::string keyOfThisProgram() {
    static const std::string key = [] {
        std::ifstream file("/proc/self/exe", std::ios::binary);
        const std::string bytes{std::istreambuf_iterator<char>(file), {}};
        return OIIO::SHA1::digest(bytes.data(), bytes.size());
    }();
    return key;
}

std::string keyOfView(const RenderRequest& request) {
    ContentKey key;
    key.add(keyOfThisProgram());
    key.add(processorName());
    addScene(key, *request.scene);
    addDisplay(key, findDisplay(*request.wall, request.display));
    addVector(key, request.wall->eyeM);
    addVector(key, glm::dvec3(request.wall->background));
    addVector(key, request.camera.positionM);
    const Orientation& turned = request.camera.orientation;
    addVector(key, {turned.yawRad, turned.pitchRad, turned.rollRad});
    key.addNumber(static_cast<int>(request.style));
    return key.text();
}

}  // namespace curvewall
