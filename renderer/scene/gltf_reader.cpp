#include "renderer/scene/gltf_reader.h"

#include "calibration/errors.h"
#include "renderer/scene/gltf_accessor.h"
#include "renderer/scene/gltf_materials.h"
#include "renderer/scene/read_file.h"
#include "renderer/scene/scene_builder.h"

#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>

#include <algorithm>
#include <array>
#include <cstring>
#include <filesystem>
#include <limits>
#include <map>
#include <string_view>
#include <utility>
#include <vector>

namespace curvewall {
namespace {

constexpr int kMaxJsonDepth = 200;
constexpr size_t kMaxPrimitives = 100'000'000;  // a small file can ask for any number through instances

constexpr std::array<std::string_view, 2> kSupportedExtensions{"KHR_materials_unlit",
                                                               "KHR_mesh_quantization"};

std::string indexed(const char* array, size_t index) {
    return std::string(array) + "[" + std::to_string(index) + "]";
}

// The JSON library parses any depth, but the values are then walked recursively.
void checkJsonDepth(const std::string& path, std::string_view json) {
    int depth = 0;
    bool inString = false;
    for (size_t i = 0; i < json.size(); ++i) {
        const char c = json[i];
        if (inString && c == '\\') {
            ++i;
        } else if (c == '"') {
            inString = !inString;
        } else if (!inString && (c == '{' || c == '[')) {
            if (++depth > kMaxJsonDepth)
                throw InputError(path, "", "JSON nested at most " + std::to_string(kMaxJsonDepth) + " deep",
                                 "deeper nesting");
        } else if (!inString && (c == '}' || c == ']')) {
            --depth;
        }
    }
}

uint32_t littleEndian32(const std::vector<uint8_t>& bytes, size_t offset) {
    uint32_t value = 0;
    for (size_t i = 4; i-- > 0;) value = value << 8 | bytes[offset + i];
    return value;
}

bool isBinary(const std::vector<uint8_t>& bytes) {
    return bytes.size() >= 4 && std::memcmp(bytes.data(), "glTF", 4) == 0;
}

// The JSON text. Checks the chunks of a binary file, whose second one tinygltf reads 8 bytes too far when the
// file is cut there.
std::string_view jsonIn(const std::string& path, const std::vector<uint8_t>& bytes) {
    const auto* text = reinterpret_cast<const char*>(bytes.data());
    if (!isBinary(bytes)) return {text, bytes.size()};
    constexpr size_t kHeaderBytes = 12, kChunkHeaderBytes = 8;
    if (bytes.size() < kHeaderBytes + kChunkHeaderBytes)
        throw InputError(path, "", "a glTF header and a chunk", std::to_string(bytes.size()) + " bytes");
    if (littleEndian32(bytes, 4) != 2)
        throw InputError(path, "version", "binary glTF 2", std::to_string(littleEndian32(bytes, 4)));
    const size_t length = littleEndian32(bytes, 8);
    if (length > bytes.size())
        throw InputError(path, "length", "a file of " + std::to_string(length) + " bytes",
                         std::to_string(bytes.size()));
    for (size_t offset = kHeaderBytes; offset + kChunkHeaderBytes <= length;) {
        const size_t chunkBytes = littleEndian32(bytes, offset);
        offset += kChunkHeaderBytes;
        if (chunkBytes > length - offset)
            throw InputError(path, "chunk", std::to_string(chunkBytes) + " bytes",
                             std::to_string(length - offset) + " before the end of the file");
        offset += chunkBytes;
    }
    return {text + kHeaderBytes + kChunkHeaderBytes, littleEndian32(bytes, kHeaderBytes)};
}

std::string trimmed(std::string text) {
    std::replace(text.begin(), text.end(), '\n', ' ');
    while (!text.empty() && text.back() == ' ') text.pop_back();
    return text;
}

GltfFile parse(const std::string& path) {
    const std::vector<uint8_t> bytes = readFile(path);
    if (bytes.size() > std::numeric_limits<uint32_t>::max())
        throw InputError(path, "", "a file below 4 GiB", std::to_string(bytes.size()) + " bytes");
    checkJsonDepth(path, jsonIn(path, bytes));

    GltfFile file{path, {}};
    tinygltf::TinyGLTF reader;
    reader.SetImageLoader(keepEncodedImage, nullptr);
    const std::string folder = std::filesystem::absolute(path).parent_path().string();
    const auto length = static_cast<unsigned int>(bytes.size());
    std::string error, warning;
    bool parsed = false;
    try {
        parsed =
            isBinary(bytes)
                ? reader.LoadBinaryFromMemory(&file.model, &error, &warning, bytes.data(), length, folder)
                : reader.LoadASCIIFromString(&file.model, &error, &warning,
                                             reinterpret_cast<const char*>(bytes.data()), length, folder);
    } catch (const std::exception& e) {  // such as an image that is an empty data URI
        error += e.what();
    }
    if (!parsed || !error.empty())
        throw InputError(path, "", "glTF 2.0", error.empty() ? "something else" : trimmed(error));
    if (!file.model.asset.version.starts_with("2."))
        throw InputError(path, "asset.version", "2.x", "\"" + file.model.asset.version + "\"");
    for (const std::string& extension : file.model.extensionsRequired)
        if (std::find(kSupportedExtensions.begin(), kSupportedExtensions.end(), extension) ==
            kSupportedExtensions.end())
            throw InputError(path, "extensionsRequired",
                             "KHR_materials_unlit or KHR_mesh_quantization at most", extension);
    return file;
}

void addTriangles(MeshPart& part, int mode, const std::vector<uint32_t>& i) {
    if (mode == TINYGLTF_MODE_TRIANGLES) {
        for (size_t k = 0; k + 2 < i.size(); k += 3) part.triangles.emplace_back(i[k], i[k + 1], i[k + 2]);
    } else if (mode == TINYGLTF_MODE_TRIANGLE_STRIP) {
        for (size_t k = 0; k + 2 < i.size(); ++k)
            part.triangles.emplace_back(i[k], i[k + 1 + k % 2], i[k + 2 - k % 2]);
    } else {
        for (size_t k = 1; k + 1 < i.size(); ++k) part.triangles.emplace_back(i[k], i[k + 1], i[0]);
    }
}

void addPrimitives(MeshPart& part, int mode, const std::vector<uint32_t>& i) {
    if (mode == TINYGLTF_MODE_POINTS) {
        part.points = i;
    } else if (mode >= TINYGLTF_MODE_TRIANGLES) {
        addTriangles(part, mode, i);
    } else {
        const size_t step = mode == TINYGLTF_MODE_LINE ? 2 : 1;
        for (size_t k = 0; k + 1 < i.size(); k += step) part.lines.emplace_back(i[k], i[k + 1]);
        if (mode == TINYGLTF_MODE_LINE_LOOP && i.size() > 1) part.lines.emplace_back(i.back(), i.front());
    }
}

glm::dmat4 localTransform(const GltfFile& file, size_t nodeIndex) {
    const tinygltf::Node& node = file.model.nodes[nodeIndex];
    const auto checked = [&](const std::vector<double>& values, const char* name, size_t size) {
        if (!values.empty() && values.size() != size)
            throw InputError(file.path, indexed("nodes", nodeIndex) + "." + name,
                             std::to_string(size) + " numbers", std::to_string(values.size()));
        return !values.empty();
    };
    glm::dmat4 transform(1);
    if (checked(node.matrix, "matrix", 16)) {
        for (size_t k = 0; k < 16; ++k)
            transform[static_cast<glm::length_t>(k / 4)][static_cast<glm::length_t>(k % 4)] = node.matrix[k];
        return transform;
    }
    if (checked(node.rotation, "rotation", 4)) {
        const glm::dquat q(node.rotation[3], node.rotation[0], node.rotation[1], node.rotation[2]);
        if (!(glm::length(q) > 0))
            throw InputError(file.path, indexed("nodes", nodeIndex) + ".rotation", "a unit quaternion",
                             "zero");
        transform = glm::mat4_cast(glm::normalize(q));
    }
    if (checked(node.scale, "scale", 3))
        for (glm::length_t k = 0; k < 3; ++k) transform[k] *= node.scale[static_cast<size_t>(k)];
    if (checked(node.translation, "translation", 3))
        transform[3] = {node.translation[0], node.translation[1], node.translation[2], 1};
    return transform;
}

// The cofactor matrix times the sign of the determinant: the inverse transpose up to a positive factor, and
// defined for flattening transforms too.
glm::dmat3 normalTransform(const glm::dmat3& m) {
    const double sign = glm::determinant(m) < 0 ? -1.0 : 1.0;
    return sign * glm::dmat3(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
}

class GltfSceneReader {
public:
    explicit GltfSceneReader(const std::string& path) : file_(parse(path)), materials_(file_, scene_) {
        scene_.name = std::filesystem::path(path).stem().string();
    }

    Scene read() {
        noteWhatIsIgnored();
        visitNodes();
        setGeometry(scene_, parts_);
        if (isEmpty(scene_))
            throw InputError(file_.path, "", "at least one triangle, line or point to draw",
                             "none" + (scene_.notes.empty() ? "" : " (" + scene_.notes.back() + ")"));
        return std::move(scene_);
    }

private:
    void noteWhatIsIgnored() {
        const tinygltf::Model& model = file_.model;
        if (model.scenes.size() > 1)
            scene_.notes.push_back("of " + std::to_string(model.scenes.size()) + " scenes only one is drawn");
        if (!model.animations.empty()) scene_.notes.emplace_back("animations are ignored");
        if (!model.skins.empty())
            scene_.notes.emplace_back("skins are ignored: meshes stand in their bind pose");
    }

    std::vector<int> rootNodes() const {
        const tinygltf::Model& model = file_.model;
        if (model.scenes.empty()) {
            std::vector<bool> isChild(model.nodes.size(), false);
            for (const tinygltf::Node& node : model.nodes)
                for (const int child : node.children)
                    if (child >= 0 && static_cast<size_t>(child) < isChild.size())
                        isChild[static_cast<size_t>(child)] = true;
            std::vector<int> roots;
            for (size_t i = 0; i < isChild.size(); ++i)
                if (!isChild[i]) roots.push_back(static_cast<int>(i));
            return roots;
        }
        const int scene = std::max(model.defaultScene, 0);
        if (static_cast<size_t>(scene) >= model.scenes.size())
            throw InputError(file_.path, "scene",
                             "a scene number below " + std::to_string(model.scenes.size()),
                             std::to_string(scene));
        return model.scenes[static_cast<size_t>(scene)].nodes;
    }

    void visitNodes() {
        struct Visit {
            int node;
            glm::dmat4 sceneFromParent;
        };
        std::vector<Visit> stack;
        std::vector<bool> visited(file_.model.nodes.size(), false);
        for (const int root : rootNodes()) stack.push_back({root, glm::dmat4(1)});
        std::reverse(stack.begin(), stack.end());
        while (!stack.empty()) {
            const Visit visit = stack.back();
            stack.pop_back();
            if (visit.node < 0 || static_cast<size_t>(visit.node) >= visited.size())
                throw InputError(file_.path, "nodes", "a node number below " + std::to_string(visited.size()),
                                 std::to_string(visit.node));
            const auto index = static_cast<size_t>(visit.node);
            if (visited[index])
                throw InputError(file_.path, indexed("nodes", index), "one parent and no cycle",
                                 "a second parent");
            visited[index] = true;
            const tinygltf::Node& node = file_.model.nodes[index];
            const glm::dmat4 sceneFromNode = visit.sceneFromParent * localTransform(file_, index);
            if (node.mesh >= 0) addMesh(node.mesh, sceneFromNode, indexed("nodes", index) + ".mesh");
            for (auto child = node.children.rbegin(); child != node.children.rend(); ++child)
                stack.push_back({*child, sceneFromNode});
        }
    }

    void addMesh(int meshIndex, const glm::dmat4& sceneFromMesh, const std::string& field) {
        if (static_cast<size_t>(meshIndex) >= file_.model.meshes.size())
            throw InputError(file_.path, field,
                             "a mesh number below " + std::to_string(file_.model.meshes.size()),
                             std::to_string(meshIndex));
        const auto [entry, isNew] = meshes_.try_emplace(meshIndex);
        if (isNew) entry->second = readMesh(static_cast<size_t>(meshIndex));
        for (const MeshPart& part : entry->second) {
            primitiveCount_ += part.primitiveCount();
            if (primitiveCount_ > kMaxPrimitives)
                throw InputError(file_.path, field,
                                 "at most " + std::to_string(kMaxPrimitives) + " triangles, lines and points",
                                 "more");
            parts_.push_back(transformed(part, sceneFromMesh));
        }
    }

    std::vector<MeshPart> readMesh(size_t meshIndex) {
        std::vector<MeshPart> parts;
        const tinygltf::Mesh& mesh = file_.model.meshes[meshIndex];
        for (size_t i = 0; i < mesh.primitives.size(); ++i) {
            const int mode = mesh.primitives[i].mode;
            const std::string field = indexed("meshes", meshIndex) + "." + indexed("primitives", i);
            if (mode < TINYGLTF_MODE_POINTS || mode > TINYGLTF_MODE_TRIANGLE_FAN)
                throw InputError(file_.path, field + ".mode", "0 to 6", std::to_string(mode));
            parts.push_back(readPrimitive(mesh.primitives[i], field));
        }
        return parts;
    }

    MeshPart readPrimitive(const tinygltf::Primitive& primitive, const std::string& field) {
        const auto attribute = [&](const std::string& name) {
            const auto found = primitive.attributes.find(name);
            return found == primitive.attributes.end() ? -1 : found->second;
        };
        const std::string attributes = field + ".attributes.";
        MeshPart part;
        if (attribute("POSITION") < 0)
            throw InputError(file_.path, attributes + "POSITION", "an accessor", "none");
        part.positionsM = readVec3(attribute("POSITION"), attributes + "POSITION");
        const size_t count = part.positionsM.size();

        if (attribute("NORMAL") >= 0) {
            part.normals = readVec3(attribute("NORMAL"), attributes + "NORMAL");
            checkCount(part.normals.size(), count, attributes + "NORMAL");
        }
        const GltfMaterial material = materials_.use(primitive.material, field + ".material");
        part.material = material.index;
        if (material.texCoordSet >= 0) {
            const std::string set = "TEXCOORD_" + std::to_string(material.texCoordSet);
            if (attribute(set) >= 0) {
                const auto numbers = readNumbers(file_, attribute(set), TINYGLTF_TYPE_VEC2, attributes + set);
                for (size_t i = 0; i + 1 < numbers.size(); i += 2)
                    part.uvs.emplace_back(numbers[i], numbers[i + 1]);
                checkCount(part.uvs.size(), count, attributes + set);
            }
        }
        if (attribute("COLOR_0") >= 0) noteOnce("vertex colours (COLOR_0) are ignored");
        if (!primitive.targets.empty()) noteOnce("morph targets are ignored");

        std::vector<uint32_t> indices;
        if (primitive.indices >= 0) {
            indices = readIndices(file_, primitive.indices, count, field + ".indices");
        } else {
            for (uint32_t i = 0; i < count; ++i) indices.push_back(i);
        }
        addPrimitives(part, primitive.mode, indices);
        return part;
    }

    std::vector<glm::dvec3> readVec3(int accessor, const std::string& field) const {
        const std::vector<double> numbers = readNumbers(file_, accessor, TINYGLTF_TYPE_VEC3, field);
        std::vector<glm::dvec3> vectors;
        vectors.reserve(numbers.size() / 3);
        for (size_t i = 0; i + 2 < numbers.size(); i += 3)
            vectors.emplace_back(numbers[i], numbers[i + 1], numbers[i + 2]);
        return vectors;
    }

    void checkCount(size_t found, size_t expected, const std::string& field) const {
        if (found != expected)
            throw InputError(file_.path, field, "as many elements as POSITION, " + std::to_string(expected),
                             std::to_string(found));
    }

    static MeshPart transformed(const MeshPart& part, const glm::dmat4& sceneFromMesh) {
        MeshPart result = part;
        const glm::dmat3 linear(sceneFromMesh);
        const glm::dmat3 forNormals = normalTransform(linear);
        for (glm::dvec3& p : result.positionsM) p = linear * p + glm::dvec3(sceneFromMesh[3]);
        for (glm::dvec3& n : result.normals) n = forNormals * n;
        if (glm::determinant(linear) < 0)
            for (glm::uvec3& t : result.triangles) std::swap(t.y, t.z);
        return result;
    }

    void noteOnce(const std::string& note) {
        if (std::find(scene_.notes.begin(), scene_.notes.end(), note) == scene_.notes.end())
            scene_.notes.push_back(note);
    }

    Scene scene_;
    GltfFile file_;
    GltfMaterials materials_;
    std::map<int, std::vector<MeshPart>> meshes_;  // in mesh coordinates, decoded once for all instances
    std::vector<MeshPart> parts_;
    size_t primitiveCount_ = 0;
};

}  // namespace

Scene readGltf(const std::string& path) { return GltfSceneReader(path).read(); }

}  // namespace curvewall
