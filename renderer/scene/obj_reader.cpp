#include "renderer/scene/obj_reader.h"

#include "calibration/errors.h"
#include "renderer/scene/read_file.h"
#include "renderer/scene/scene_builder.h"
#include "renderer/scene/texture.h"

#include <assimp/Importer.hpp>
#include <assimp/material.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <filesystem>
#include <map>
#include <vector>

namespace curvewall {
namespace {

glm::dvec3 dvec3From(const aiVector3D& v) { return {v.x, v.y, v.z}; }

std::string textureNameOf(const aiMaterial& material, aiTextureType type) {
    aiString name;
    if (material.GetTexture(type, 0, &name) != aiReturn_SUCCESS) return {};
    std::string path = name.C_Str();
    std::replace(path.begin(), path.end(), '\\', '/');  // written on Windows, read anywhere
    return path;
}

class ObjMaterials {
public:
    ObjMaterials(const std::string& path, Scene& scene) : path_(path), scene_(scene) {}

    void add(const aiMaterial& source) {
        Material material;
        material.name = source.GetName().C_Str();
        aiColor3D diffuse(1, 1, 1);
        float opacity = 1;
        source.Get(AI_MATKEY_COLOR_DIFFUSE, diffuse);
        source.Get(AI_MATKEY_OPACITY, opacity);
        material.baseColor = {diffuse.r, diffuse.g, diffuse.b, opacity};  // MTL does not say; taken as linear

        const std::string image = textureNameOf(source, aiTextureType_DIFFUSE);
        const std::string mask = textureNameOf(source, aiTextureType_OPACITY);
        if (!image.empty()) material.texture = texture(image);
        // A dissolve map is read where it is the alpha of the colour map, as exporters write it for leaves.
        const bool hasMask = !mask.empty() && mask == image;
        if (opacity < 1 || hasMask) material.blending = Blending::alpha;
        if (!mask.empty() && !hasMask)
            scene_.notes.push_back("material \"" + material.name + "\": map_d is ignored");
        scene_.materials.push_back(std::move(material));
    }

private:
    int texture(const std::string& name) {
        const auto known = textures_.find(name);
        if (known != textures_.end()) return known->second;
        return textures_[name] = load(name);
    }

    int load(const std::string& name) {
        const std::filesystem::path file = std::filesystem::path(path_).parent_path() / name;
        std::error_code error;
        if (!std::filesystem::is_regular_file(file, error)) {
            scene_.notes.push_back("texture \"" + name + "\" is missing: drawn in plain colour");
            return -1;
        }
        MipLevel image = decodeImage(file.string(), "", readFile(file.string()));
        scene_.textures.push_back(makeTexture(name, image.sizePx, std::move(image.texels)));
        return static_cast<int>(scene_.textures.size()) - 1;
    }

    std::string path_;
    Scene& scene_;
    std::map<std::string, int> textures_;
};

MeshPart partFrom(const std::string& path, const aiMesh& mesh, const std::string& field) {
    MeshPart part;
    part.material = mesh.mMaterialIndex;
    for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
        part.positionsM.push_back(dvec3From(mesh.mVertices[i]));
        if (mesh.HasNormals()) part.normals.push_back(dvec3From(mesh.mNormals[i]));
        if (mesh.HasTextureCoords(0))
            part.uvs.emplace_back(mesh.mTextureCoords[0][i].x, 1.0f - mesh.mTextureCoords[0][i].y);
    }
    for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
        const aiFace& face = mesh.mFaces[i];
        if (face.mNumIndices != 3) continue;
        for (unsigned k = 0; k < 3; ++k)
            if (face.mIndices[k] >= mesh.mNumVertices)
                throw InputError(path, field, "indices below " + std::to_string(mesh.mNumVertices),
                                 std::to_string(face.mIndices[k]));
        part.triangles.emplace_back(face.mIndices[0], face.mIndices[1], face.mIndices[2]);
    }
    return part;
}

// The elements `p` and `l`, of which the latter come as single segments. They have no normals in the file.
MeshPart strokesFrom(const std::string& path, const aiMesh& mesh, const std::string& field) {
    MeshPart part;
    part.material = mesh.mMaterialIndex;
    std::vector<uint32_t> indices;
    const auto vertex = [&](unsigned index) {
        if (index >= mesh.mNumVertices)
            throw InputError(path, field, "indices below " + std::to_string(mesh.mNumVertices),
                             std::to_string(index));
        part.positionsM.push_back(dvec3From(mesh.mVertices[index]));
        if (mesh.HasTextureCoords(0))
            part.uvs.emplace_back(mesh.mTextureCoords[0][index].x, 1.0f - mesh.mTextureCoords[0][index].y);
        return static_cast<uint32_t>(part.positionsM.size()) - 1;
    };
    for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
        const aiFace& face = mesh.mFaces[i];
        if (face.mNumIndices == 1) part.points.push_back(vertex(face.mIndices[0]));
        if (face.mNumIndices == 2) {
            const uint32_t from = vertex(face.mIndices[0]);
            part.lines.emplace_back(from, vertex(face.mIndices[1]));
        }
    }
    return part;
}

const aiScene& require(const Assimp::Importer& importer, const aiScene* source, const std::string& path) {
    if (source == nullptr || source->mRootNode == nullptr)
        throw InputError(path, "", "a Wavefront OBJ file",
                         source == nullptr ? importer.GetErrorString() : "an incomplete one");
    return *source;
}

}  // namespace

Scene readObj(const std::string& path) {
    Assimp::Importer importer;
    std::vector<MeshPart> parts;
    const auto addParts = [&](const aiScene& source, const auto& read) {
        for (unsigned i = 0; i < source.mNumMeshes; ++i)
            parts.push_back(read(path, *source.mMeshes[i], "meshes[" + std::to_string(i) + "]"));
    };
    // Taken before polygons become triangles: one with holes or spikes leaves points and lines too, which are
    // not drawn.
    addParts(require(importer, importer.ReadFile(path, 0), path), strokesFrom);
    const aiScene& source =
        require(importer,
                importer.ApplyPostProcessing(aiProcess_Triangulate | aiProcess_SortByPType |
                                             aiProcess_JoinIdenticalVertices),
                path);
    addParts(source, partFrom);

    Scene scene;
    scene.name = std::filesystem::path(path).stem().string();
    ObjMaterials materials(path, scene);
    for (unsigned i = 0; i < source.mNumMaterials; ++i) materials.add(*source.mMaterials[i]);
    for (const MeshPart& part : parts)
        if (part.material >= scene.materials.size()) throw InputError(path, "meshes", "a material", "none");
    setGeometry(scene, parts);
    if (isEmpty(scene)) throw InputError(path, "", "at least one triangle, line or point to draw", "none");
    return scene;
}

}  // namespace curvewall
