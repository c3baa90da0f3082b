#include "renderer/scene/gltf_materials.h"

#include "calibration/errors.h"
#include "renderer/scene/texture.h"

namespace curvewall {
namespace {

Wrap wrapFrom(const GltfFile& file, int code, const std::string& field) {
    switch (code) {
        case TINYGLTF_TEXTURE_WRAP_REPEAT:
            return Wrap::repeat;
        case TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE:
            return Wrap::clampToEdge;
        case TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT:
            return Wrap::mirroredRepeat;
        default:
            throw InputError(file.path, field,
                             "10497 (repeat), 33071 (clamp to edge) or 33648 (mirrored repeat)",
                             std::to_string(code));
    }
}

MipLevel decodedImage(const GltfFile& file, int imageIndex) {
    const tinygltf::Image& image = file.model.images[static_cast<size_t>(imageIndex)];
    const std::string field = "images[" + std::to_string(imageIndex) + "]";
    if (image.bufferView >= 0)
        return decodeImage(file.path, field, bufferViewBytes(file, image.bufferView, field + ".bufferView"));
    if (image.image.empty())
        throw InputError(file.path, field + ".uri", "an image file",
                         "no readable file \"" + image.uri + "\"");
    return decodeImage(file.path, field, image.image);
}

// Core glTF knows no additive blending; `extras` is its place for what an application adds.
bool asksForAdditive(const GltfFile& file, const tinygltf::Material& material, const std::string& field) {
    if (!material.extras.IsObject() || !material.extras.Has("blending")) return false;
    const tinygltf::Value& blending = material.extras.Get("blending");
    const std::string found = blending.IsString() ? "\"" + blending.Get<std::string>() + "\"" : "no text";
    if (found != "\"additive\"")
        throw InputError(file.path, field + ".extras.blending", "\"additive\"", found);
    if (material.alphaMode != "BLEND")
        throw InputError(file.path, field + ".alphaMode", "BLEND, because extras.blending is additive",
                         "\"" + material.alphaMode + "\"");
    return true;
}

}  // namespace

GltfMaterial GltfMaterials::use(int gltfIndex, const std::string& field) {
    const auto known = materials_.find(gltfIndex);
    if (known != materials_.end()) return known->second;
    if (gltfIndex < -1 || gltfIndex >= static_cast<int>(file_.model.materials.size()))
        throw InputError(file_.path, field,
                         "a material number below " + std::to_string(file_.model.materials.size()),
                         std::to_string(gltfIndex));
    return materials_[gltfIndex] = convert(gltfIndex);
}

GltfMaterial GltfMaterials::convert(int gltfIndex) {
    const tinygltf::Material source =
        gltfIndex < 0 ? tinygltf::Material{} : file_.model.materials[static_cast<size_t>(gltfIndex)];
    const std::string field = "materials[" + std::to_string(gltfIndex) + "]";
    const std::string quotedName = "material \"" + source.name + "\"";

    Material material;
    material.name = source.name;
    const auto& factor = source.pbrMetallicRoughness.baseColorFactor;
    if (factor.size() == 4) material.baseColor = {factor[0], factor[1], factor[2], factor[3]};
    material.doubleSided = source.doubleSided;
    material.unlit = source.extensions.contains("KHR_materials_unlit");
    if (source.alphaMode == "MASK") {
        material.alphaCutoff = static_cast<float>(source.alphaCutoff);
    } else if (source.alphaMode == "BLEND") {
        material.blending = Blending::alpha;
    } else if (source.alphaMode != "OPAQUE") {
        throw InputError(file_.path, field + ".alphaMode", "OPAQUE, MASK or BLEND",
                         "\"" + source.alphaMode + "\"");
    }
    if (asksForAdditive(file_, source, field)) material.blending = Blending::additive;

    GltfMaterial converted{static_cast<uint32_t>(scene_.materials.size()), -1};
    const tinygltf::TextureInfo& texture = source.pbrMetallicRoughness.baseColorTexture;
    if (texture.index >= 0) {
        material.texture = useTexture(texture.index, field + ".pbrMetallicRoughness.baseColorTexture");
        converted.texCoordSet = texture.texCoord;
        if (texture.extensions.contains("KHR_texture_transform"))
            noteOnce(quotedName + ": KHR_texture_transform is ignored");
    }
    scene_.materials.push_back(std::move(material));
    return converted;
}

int GltfMaterials::useTexture(int gltfTexture, const std::string& field) {
    const tinygltf::Model& model = file_.model;
    if (gltfTexture >= static_cast<int>(model.textures.size()))
        throw InputError(file_.path, field + ".index",
                         "a texture number below " + std::to_string(model.textures.size()),
                         std::to_string(gltfTexture));
    const tinygltf::Texture& texture = model.textures[static_cast<size_t>(gltfTexture)];
    const std::string textureField = "textures[" + std::to_string(gltfTexture) + "]";
    if (texture.source < 0 || texture.source >= static_cast<int>(model.images.size()))
        throw InputError(file_.path, textureField + ".source",
                         "an image number below " + std::to_string(model.images.size()) +
                             " (PNG or JPEG; image extensions are not supported)",
                         texture.source < 0 ? "none" : std::to_string(texture.source));
    Wrap wrapS = Wrap::repeat, wrapT = Wrap::repeat;
    if (texture.sampler >= static_cast<int>(model.samplers.size()))
        throw InputError(file_.path, textureField + ".sampler",
                         "a sampler number below " + std::to_string(model.samplers.size()),
                         std::to_string(texture.sampler));
    if (texture.sampler >= 0) {
        const tinygltf::Sampler& sampler = model.samplers[static_cast<size_t>(texture.sampler)];
        const std::string samplerField = "samplers[" + std::to_string(texture.sampler) + "]";
        wrapS = wrapFrom(file_, sampler.wrapS, samplerField + ".wrapS");
        wrapT = wrapFrom(file_, sampler.wrapT, samplerField + ".wrapT");
    }

    const auto [entry, isNew] =
        textures_.try_emplace({texture.source, wrapS, wrapT}, static_cast<int>(scene_.textures.size()));
    if (isNew) {
        const tinygltf::Image& image = model.images[static_cast<size_t>(texture.source)];
        MipLevel decoded = decodedImage(file_, texture.source);
        scene_.textures.push_back(makeTexture(image.name.empty() ? image.uri : image.name, decoded.sizePx,
                                              std::move(decoded.texels), wrapS, wrapT));
    }
    return entry->second;
}

void GltfMaterials::noteOnce(const std::string& note) {
    if (notes_.insert(note).second) scene_.notes.push_back(note);
}

bool keepEncodedImage(tinygltf::Image* image, int /*imageIndex*/, std::string* /*error*/,
                      std::string* /*warning*/, int /*requestedWidth*/, int /*requestedHeight*/,
                      const unsigned char* bytes, int size, void* /*userData*/) {
    // What lies in a buffer view is read from there later: at this point nobody has checked its bounds.
    if (image->bufferView < 0 && size > 0) image->image.assign(bytes, bytes + size);
    return true;
}

}  // namespace curvewall
