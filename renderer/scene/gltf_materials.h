#pragma once
// The materials and base colour textures of a glTF file, converted as primitives ask for them.

#include "renderer/scene/gltf_accessor.h"
#include "renderer/scene/scene.h"

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <tuple>

namespace curvewall {

struct GltfMaterial {
    uint32_t index = 0;    // into Scene::materials
    int texCoordSet = -1;  // the TEXCOORD_n its texture uses, or -1
};

class GltfMaterials {
public:
    // Appends to `scene`; both must outlive this object.
    GltfMaterials(const GltfFile& file, Scene& scene) : file_(file), scene_(scene) {}

    // `gltfIndex` -1 is glTF's default material; `field` is what refers to it.
    GltfMaterial use(int gltfIndex, const std::string& field);

private:
    GltfMaterial convert(int gltfIndex);
    int useTexture(int gltfTexture, const std::string& field);
    void noteOnce(const std::string& note);

    const GltfFile& file_;
    Scene& scene_;
    std::map<int, GltfMaterial> materials_;
    std::map<std::tuple<int, Wrap, Wrap>, int> textures_;  // by image and sampler
    std::set<std::string> notes_;
};

// Keeps the encoded bytes of images outside buffer views (data URIs, files) in the model; give it to
// TinyGLTF::SetImageLoader.
bool keepEncodedImage(tinygltf::Image* image, int imageIndex, std::string* error, std::string* warning,
                      int requestedWidth, int requestedHeight, const unsigned char* bytes, int size,
                      void* userData);

}  // namespace curvewall
