#include "calibration/errors.h"
#include "renderer/scene/load_scene.h"
#include "renderer/scene/random.h"
#include "tests/renderer/scene_checks.h"

#include <OpenImageIO/imageio.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>

namespace curvewall {
namespace {

using nlohmann::json;
using testing::Contains;
using testing::HasSubstr;

constexpr int kByte = 5120, kUnsignedByte = 5121, kUnsignedShort = 5123, kUnsignedInt = 5125, kFloat = 5126;

std::string base64(const std::string& bytes) {
    constexpr const char* kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (size_t i = 0; i < bytes.size(); i += 3) {
        uint32_t group = 0;
        for (size_t k = 0; k < 3; ++k)
            group = group << 8 | (i + k < bytes.size() ? static_cast<uint8_t>(bytes[i + k]) : 0u);
        for (size_t k = 0; k < 4; ++k)
            text += i + k > bytes.size() ? '=' : kDigits[group >> (18 - 6 * k) & 63];
    }
    return text;
}

// A glTF document under construction, with one buffer.
struct Document {
    json root = {{"asset", {{"version", "2.0"}}},
                 {"scene", 0},
                 {"scenes", {{{"nodes", {0}}}}},
                 {"nodes", {{{"mesh", 0}}}}};
    std::string buffer;

    template <class Number>
    int addView(const std::vector<Number>& numbers) {
        while (buffer.size() % 4 != 0) buffer += '\0';
        const size_t bytes = numbers.size() * sizeof(Number);
        root["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", buffer.size()}, {"byteLength", bytes}});
        buffer.append(reinterpret_cast<const char*>(numbers.data()), bytes);
        return static_cast<int>(root["bufferViews"].size()) - 1;
    }
    template <class Number>
    int add(const std::vector<Number>& numbers, int componentType, const std::string& type) {
        const size_t components = type == "SCALAR" ? 1 : type == "VEC2" ? 2 : 3;
        const int view = addView(numbers);
        root["accessors"].push_back({{"bufferView", view},
                                     {"componentType", componentType},
                                     {"count", numbers.size() / components},
                                     {"type", type}});
        return static_cast<int>(root["accessors"].size()) - 1;
    }
    int addVec3(const std::vector<float>& numbers) { return add(numbers, kFloat, "VEC3"); }
    json& addPrimitive(const json& attributes) {
        root["meshes"][0]["primitives"].push_back({{"attributes", attributes}});
        return root["meshes"][0]["primitives"].back();
    }

    std::string gltf() const {
        json complete = root;
        complete["buffers"] = {{{"byteLength", buffer.size()},
                                {"uri", "data:application/octet-stream;base64," + base64(buffer)}}};
        return complete.dump();
    }
    std::string glb() const {
        json complete = root;
        complete["buffers"] = {{{"byteLength", buffer.size()}}};
        std::string text = complete.dump(), data = buffer;
        text.resize((text.size() + 3) / 4 * 4, ' ');
        data.resize((data.size() + 3) / 4 * 4);
        const auto word = [](size_t value) {
            const auto number = static_cast<uint32_t>(value);
            return std::string(reinterpret_cast<const char*>(&number), 4);
        };
        return "glTF" + word(2) + word(12 + 8 + text.size() + 8 + data.size()) + word(text.size()) + "JSON" +
               text + word(data.size()) + std::string("BIN\0", 4) + data;
    }
};

const std::vector<float> kTriangle{0, 0, 0, 1, 0, 0, 0, 1, 0};

Document triangleDocument() {
    Document document;
    const int positions = document.addVec3(kTriangle);
    document.addPrimitive({{"POSITION", positions}});
    return document;
}

Scene load(const std::string& content, const std::string& name = "a.gltf") {
    const test::TemporaryFolder folder;
    Scene scene = loadScene(folder.write(name, content));
    test::expectSound(scene);
    return scene;
}

std::string refusal(const std::string& content, const std::string& name = "a.gltf") {
    return test::messageOf<InputError>([&] { load(content, name); });
}

glm::dvec3 inScene(const Scene& scene, uint32_t vertex) {
    return scene.originM + glm::dvec3(scene.positions[vertex]);
}

TEST(Gltf, ReadsATriangleAsTextAndAsBinary) {
    for (const Scene& scene : {load(triangleDocument().gltf()), load(triangleDocument().glb(), "a.glb"),
                               load(triangleDocument().glb(), "a.gltf")}) {
        ASSERT_EQ(scene.triangles.size(), 1u);
        for (const glm::vec3& normal : scene.normals)
            EXPECT_EQ(normal, glm::vec3(0, 0, 1)) << "flat, because the file has none";
        EXPECT_FALSE(scene.materials[0].doubleSided) << "the default of glTF";
        EXPECT_EQ(scene.defaultCamera, Camera{});
    }
}

TEST(Gltf, KeepsATenthOfAMillimetreAThousandKilometresAway) {
    Document document;
    const std::vector<float> positions{0, 0, 0, 1.2345678f, 0, 0, 0, 0.7654321f, 0.1111111f};
    document.addPrimitive({{"POSITION", document.addVec3(positions)}});
    document.root["nodes"] = {{{"translation", {1e6, -1e6, 1e6}}, {"children", {1}}},
                              {{"mesh", 0}, {"translation", {0.001, 0.002, 0.003}}}};
    const Scene scene = load(document.gltf());
    for (const uint32_t vertex : {0u, 1u, 2u}) {
        const glm::dvec3 local(positions[3 * vertex], positions[3 * vertex + 1], positions[3 * vertex + 2]);
        const glm::dvec3 expected = glm::dvec3(1e6, -1e6, 1e6) + glm::dvec3(0.001, 0.002, 0.003) + local;
        EXPECT_LT(
            glm::distance(inScene(scene, scene.triangles[0][static_cast<glm::length_t>(vertex)]), expected),
            1e-6);
    }
}

TEST(Gltf, ComposesTransformsOfAHierarchy) {
    Document document = triangleDocument();
    // 90 degrees about y turns x to -z; then scale by 2, then shift.
    document.root["nodes"] = {
        {{"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 10, 20, 30, 1}}, {"children", {1}}},
        {{"scale", {2, 2, 2}}, {"children", {2}}},
        {{"mesh", 0},
         {"rotation", {0, 0.70710678118654752, 0, 0.70710678118654752}},
         {"translation", {0, 0, 1}}}};
    const Scene scene = load(document.gltf());
    const glm::uvec3 t = scene.triangles[0];
    EXPECT_LT(glm::distance(inScene(scene, t.x), {10, 20, 32}), 1e-6);
    EXPECT_LT(glm::distance(inScene(scene, t.y), {10, 20, 30}), 1e-6);
    EXPECT_LT(glm::distance(inScene(scene, t.z), {10, 22, 32}), 1e-6);
    EXPECT_LT(glm::distance(scene.normals[t.x], {1, 0, 0}), 1e-6f);
}

TEST(Gltf, DrawsAMeshOnceForEachNode) {
    Document document = triangleDocument();
    document.root["scenes"][0]["nodes"] = {0, 1, 2};
    document.root["nodes"] = {
        {{"mesh", 0}}, {{"mesh", 0}, {"translation", {5, 0, 0}}}, {{"mesh", 0}, {"translation", {0, 7, 0}}}};
    EXPECT_EQ(load(document.gltf()).triangles.size(), 3u);
}

TEST(Gltf, KeepsTheFrontInFrontUnderNegativeScale) {
    Document document;
    const int normals = document.addVec3({0, 0, 1, 0, 0, 1, 0, 0, 1});
    document.addPrimitive({{"POSITION", document.addVec3(kTriangle)}, {"NORMAL", normals}});
    for (const json& scale :
         {json{-1, 1, 1}, json{1, -2, 1}, json{1, 1, -3}, json{-1, -1, -1}, json{-1, -1, 1}}) {
        document.root["nodes"][0]["scale"] = scale;
        const Scene scene = load(document.gltf());
        // The mesh's front, +z, mirrored with the mesh.
        const glm::vec3 front(0, 0, scale[2] > 0 ? 1 : -1);
        EXPECT_EQ(scene.normals[0], front) << scale;
        EXPECT_EQ(test::cornersAgainstWinding(scene), 0u) << scale;
    }
}

TEST(Gltf, TransformsNormalsByTheInverseTranspose) {
    Document document;
    const float d = 0.70710678f;
    const int normals = document.addVec3({d, d, 0, d, d, 0, d, d, 0});
    document.addPrimitive({{"POSITION", document.addVec3({1, 0, 0, 0, 1, 0, 0, 1, 1})}, {"NORMAL", normals}});
    document.root["nodes"][0]["scale"] = {4, 1, 1};
    const Scene scene = load(document.gltf());
    EXPECT_LT(glm::distance(scene.normals[0], glm::normalize(glm::vec3(1, 4, 0))), 1e-6f);
}

TEST(Gltf, ReadsStripsFansAndLists) {
    const std::vector<float> fan{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
    const std::vector<float> strip{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};
    for (const bool isIndexed : {false, true})
        for (const bool isFan : {false, true}) {
            Document document;
            json& primitive = document.addPrimitive({{"POSITION", document.addVec3(isFan ? fan : strip)}});
            primitive["mode"] = isFan ? 6 : 5;
            if (isIndexed)
                primitive["indices"] =
                    document.add(std::vector<uint8_t>{0, 1, 2, 3}, kUnsignedByte, "SCALAR");
            const Scene scene = load(document.gltf());
            ASSERT_EQ(scene.triangles.size(), 2u);
            for (const glm::uvec3& t : scene.triangles)
                EXPECT_EQ(test::crossOf(scene, t), glm::dvec3(0, 0, 1)) << "every front is +z";
        }
}

TEST(Gltf, ReadsAllIndexTypes) {
    for (const int type : {kUnsignedByte, kUnsignedShort, kUnsignedInt}) {
        Document document;
        json& primitive =
            document.addPrimitive({{"POSITION", document.addVec3({9, 9, 9, 0, 0, 0, 1, 0, 0, 0, 1, 0})}});
        primitive["indices"] =
            type == kUnsignedByte    ? document.add(std::vector<uint8_t>{1, 2, 3}, type, "SCALAR")
            : type == kUnsignedShort ? document.add(std::vector<uint16_t>{1, 2, 3}, type, "SCALAR")
                                     : document.add(std::vector<uint32_t>{1, 2, 3}, type, "SCALAR");
        const Scene scene = load(document.gltf());
        EXPECT_EQ(inScene(scene, scene.triangles[0].y), glm::dvec3(1, 0, 0));
        EXPECT_EQ(scene.positions.size(), 3u) << "a vertex that no triangle uses is left out";
    }
}

TEST(Gltf, ReadsSparseAccessors) {
    Document document = triangleDocument();
    json& accessor = document.root["accessors"][0];
    accessor["sparse"] = {
        {"count", 1},
        {"indices",
         {{"bufferView", document.addView(std::vector<uint16_t>{1})}, {"componentType", kUnsignedShort}}},
        {"values", {{"bufferView", document.addView(std::vector<float>{5, 0, 0})}}}};
    Scene scene = load(document.gltf());
    EXPECT_EQ(inScene(scene, scene.triangles[0].y), glm::dvec3(5, 0, 0));

    document.root["accessors"][0]["sparse"]["indices"]["bufferView"] =
        document.addView(std::vector<uint16_t>{3});
    EXPECT_THAT(refusal(document.gltf()),
                HasSubstr("POSITION.sparse.indices: expected an index below 3, found 3"));
}

TEST(Gltf, ReadsInterleavedAndNormalizedAttributes) {
    Document document;
    struct Vertex {
        float position[3];
        uint16_t uv[2];
    };
    const std::vector<Vertex> vertices{{{0, 0, 0}, {0, 65535}}, {{1, 0, 0}, {65535, 0}}, {{0, 1, 0}, {0, 0}}};
    document.root["bufferViews"] = {
        {{"buffer", 0}, {"byteLength", sizeof(Vertex) * 3}, {"byteStride", sizeof(Vertex)}}};
    document.buffer.assign(reinterpret_cast<const char*>(vertices.data()), sizeof(Vertex) * 3);
    document.root["accessors"] = {
        {{"bufferView", 0}, {"componentType", kFloat}, {"count", 3}, {"type", "VEC3"}},
        {{"bufferView", 0},
         {"byteOffset", 12},
         {"componentType", kUnsignedShort},
         {"normalized", true},
         {"count", 3},
         {"type", "VEC2"}}};
    document.addPrimitive({{"POSITION", 0}, {"TEXCOORD_1", 1}})["material"] = 0;
    const int image = document.addView(std::vector<uint8_t>{1});
    document.root["images"] = {{{"bufferView", image}, {"mimeType", "image/png"}}};
    document.root["textures"] = {{{"source", 0}}};
    document.root["materials"] = {
        {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}, {"texCoord", 1}}}}}}};
    EXPECT_THAT(refusal(document.gltf()), HasSubstr("images[0]: expected a PNG or JPEG image"));
    document.root["materials"] = {{{"pbrMetallicRoughness", json::object()}}};
    EXPECT_EQ(load(document.gltf()).uvs[0], glm::vec2(0)) << "no texture, no coordinates";
}

std::string pngFile(const test::TemporaryFolder& folder) {
    const auto output = OIIO::ImageOutput::create("t.png");
    OIIO::ImageSpec spec(1, 2, 4, OIIO::TypeDesc::UINT8);
    spec["oiio:UnassociatedAlpha"] = 1;
    const std::vector<uint8_t> pixels{200, 100, 50, 40, 1, 2, 3, 255};
    if (!output->open(folder.pathOf("t.png"), spec) ||
        !output->write_image(OIIO::TypeDesc::UINT8, pixels.data()) || !output->close())
        throw std::runtime_error(output->geterror());
    std::ifstream stream(folder.pathOf("t.png"), std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

TEST(Gltf, ReadsTexturesFromFilesDataUrisAndBuffers) {
    const test::TemporaryFolder folder;
    const std::string png = pngFile(folder);
    for (int kind = 0; kind < 3; ++kind) {
        Document document;
        const int uvs = document.add(std::vector<float>{0.25f, 0, 1, 0, 0, 1}, kFloat, "VEC2");
        document.addPrimitive({{"POSITION", document.addVec3(kTriangle)}, {"TEXCOORD_1", uvs}})["material"] =
            0;
        document.root["materials"] = {{{"name", "leaf"},
                                       {"alphaMode", "MASK"},
                                       {"alphaCutoff", 0.3},
                                       {"doubleSided", true},
                                       {"extensions", {{"KHR_materials_unlit", json::object()}}},
                                       {"pbrMetallicRoughness",
                                        {{"baseColorFactor", {0.5, 0.25, 1, 0.75}},
                                         {"baseColorTexture", {{"index", 0}, {"texCoord", 1}}}}}}};
        document.root["samplers"] = {{{"wrapS", 33071}, {"wrapT", 33648}}};
        document.root["textures"] = {{{"source", 0}, {"sampler", 0}}};
        document.root["images"] = json::array();
        if (kind == 0) document.root["images"] = {{{"uri", "t.png"}}};
        if (kind == 1) document.root["images"] = {{{"uri", "data:image/png;base64," + base64(png)}}};
        if (kind == 2) {
            const int view = document.addView(std::vector<char>(png.begin(), png.end()));
            document.root["images"] = {{{"bufferView", view}, {"mimeType", "image/png"}}};
        }
        const Scene scene = loadScene(folder.write("a.gltf", document.gltf()));
        test::expectSound(scene);
        const Material& material = scene.materials[scene.ranges[0].material];
        EXPECT_EQ(material.name, "leaf");
        EXPECT_EQ(material.baseColor, glm::vec4(0.5f, 0.25f, 1, 0.75f));
        EXPECT_FLOAT_EQ(material.alphaCutoff, 0.3f);
        EXPECT_TRUE(material.doubleSided);
        EXPECT_TRUE(material.unlit);
        ASSERT_EQ(material.texture, 0);
        const Texture& texture = scene.textures[0];
        EXPECT_EQ(texture.wrapS, Wrap::clampToEdge);
        EXPECT_EQ(texture.wrapT, Wrap::mirroredRepeat);
        EXPECT_EQ(texture.levels[0].texels[0], glm::u8vec4(200, 100, 50, 40))
            << "row 0 is the top, alpha apart";
        EXPECT_EQ(texture.levels.size(), 2u);
        EXPECT_EQ(scene.uvs[scene.triangles[0].x], glm::vec2(0.25f, 0));
    }
}

TEST(Gltf, RefusesAMissingTextureOnlyIfItIsDrawn) {
    Document document = triangleDocument();
    document.root["images"] = {{{"uri", "gone.png"}}};
    document.root["textures"] = {{{"source", 0}}};
    document.root["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
    EXPECT_EQ(load(document.gltf()).triangles.size(), 1u);
    document.root["meshes"][0]["primitives"][0]["material"] = 0;
    EXPECT_THAT(refusal(document.gltf()),
                HasSubstr("images[0].uri: expected an image file, found no readable file \"gone.png\""));
}

TEST(Gltf, ReadsHowAMaterialBlends) {
    Document document = triangleDocument();
    document.root["meshes"][0]["primitives"][0]["material"] = 0;
    const auto blendingOf = [&](const json& material) {
        document.root["materials"] = {material};
        const Scene scene = load(document.gltf());
        EXPECT_LT(scene.materials[0].alphaCutoff, 0) << "nothing is cut off";
        EXPECT_TRUE(scene.notes.empty());
        return scene.materials[0].blending;
    };
    EXPECT_EQ(blendingOf({{"name", "stone"}}), Blending::none);
    EXPECT_EQ(blendingOf({{"alphaMode", "BLEND"}}), Blending::alpha);
    EXPECT_EQ(blendingOf({{"alphaMode", "BLEND"}, {"extras", {{"author", "me"}}}}), Blending::alpha);
    EXPECT_EQ(blendingOf({{"alphaMode", "BLEND"}, {"extras", {{"blending", "additive"}}}}),
              Blending::additive);
}

TEST(Gltf, RefusesABlendingItDoesNotKnow) {
    Document document = triangleDocument();
    document.root["meshes"][0]["primitives"][0]["material"] = 0;
    const auto refusalOf = [&](const json& material) {
        document.root["materials"] = {material};
        return refusal(document.gltf());
    };
    EXPECT_THAT(refusalOf({{"alphaMode", "BLEND"}, {"extras", {{"blending", "screen"}}}}),
                HasSubstr("materials[0].extras.blending: expected \"additive\", found \"screen\""));
    EXPECT_THAT(refusalOf({{"alphaMode", "BLEND"}, {"extras", {{"blending", 1}}}}),
                HasSubstr("materials[0].extras.blending: expected \"additive\", found no text"));
    EXPECT_THAT(refusalOf({{"extras", {{"blending", "additive"}}}}),
                HasSubstr("materials[0].alphaMode: expected BLEND, because"));
    EXPECT_THAT(refusalOf({{"alphaMode", "GLASS"}}), HasSubstr("expected OPAQUE, MASK or BLEND"));
}

// Ends of all lines, or all points, in scene coordinates.
std::vector<glm::dvec3> strokeEnds(const Scene& scene) {
    std::vector<glm::dvec3> ends;
    for (const uint32_t point : scene.points) ends.push_back(inScene(scene, point));
    for (const glm::uvec2& line : scene.lines) {
        ends.push_back(inScene(scene, line.x));
        ends.push_back(inScene(scene, line.y));
    }
    return ends;
}

TEST(Gltf, ReadsPointsAndLines) {
    const std::vector<float> corners{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1};
    const glm::dvec3 a(10, 0, 0), b(12, 0, 0), c(12, 2, 0), d(10, 2, 0), e(10, 0, 2);
    const std::vector<std::vector<glm::dvec3>> expected{{a, b, c, d, e},  // points
                                                        {a, b, c, d},     // lines: the fifth is left over
                                                        {a, b, b, c, c, d, d, e, e, a},  // loop
                                                        {a, b, b, c, c, d, d, e}};       // strip
    for (const bool isIndexed : {false, true})
        for (size_t mode = 0; mode < 4; ++mode) {
            Document document;
            json& primitive = document.addPrimitive({{"POSITION", document.addVec3(corners)}});
            primitive["mode"] = mode;
            if (isIndexed)
                primitive["indices"] =
                    document.add(std::vector<uint8_t>{0, 1, 2, 3, 4}, kUnsignedByte, "SCALAR");
            document.root["nodes"][0]["scale"] = {2, 2, 2};
            document.root["nodes"][0]["translation"] = {10, 0, 0};
            const Scene scene = load(document.gltf());
            EXPECT_EQ(strokeEnds(scene), expected[mode]) << mode;
            EXPECT_TRUE(scene.triangles.empty());
            EXPECT_TRUE(scene.notes.empty());
            EXPECT_EQ(scene.originM, glm::dvec3(11, 1, mode == 1 ? 0 : 1)) << "the middle of what is drawn";
        }
}

TEST(Gltf, StrokesWithoutNormalsAreUnlit) {
    Document document = triangleDocument();
    const int normals = document.addVec3({0, 0, 2, 0, 0, 2, 0, 0, 2});
    document.addPrimitive({{"POSITION", 0}})["mode"] = 3;
    document.addPrimitive({{"POSITION", 0}, {"NORMAL", normals}})["mode"] = 3;
    document.addPrimitive({{"POSITION", 0}})["mode"] = 0;
    document.root["materials"] = {{{"alphaMode", "BLEND"}}};
    for (json& primitive : document.root["meshes"][0]["primitives"]) primitive["material"] = 0;
    const Scene scene = load(document.gltf());
    ASSERT_EQ(scene.lineRanges.size(), 2u);
    const Material& bare = scene.materials[scene.lineRanges[0].material];
    EXPECT_TRUE(bare.unlit);
    EXPECT_EQ(bare.blending, Blending::alpha) << "it is the same otherwise";
    EXPECT_FALSE(scene.materials[scene.lineRanges[1].material].unlit);
    EXPECT_EQ(scene.normals[scene.lines[2].x], glm::vec3(0, 0, 1));
    EXPECT_EQ(scene.pointRanges[0].material, scene.lineRanges[0].material);
    EXPECT_FALSE(scene.materials[scene.ranges[0].material].unlit) << "the triangle keeps its light";
}

TEST(Gltf, DropsStrokesThatCannotBeDrawn) {
    constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
    Document document;
    const int positions = document.addVec3({0, 0, 0, kNaN, 0, 0, 3, 0, 0, 3, 0, 0, 0, 0, 0});
    for (const int mode : {0, 3}) document.addPrimitive({{"POSITION", positions}})["mode"] = mode;
    const Scene scene = load(document.gltf());
    EXPECT_EQ(scene.points.size(), 4u);
    EXPECT_EQ(scene.lines.size(), 1u);
    EXPECT_THAT(scene.notes, Contains(HasSubstr("dropped 4 points or lines")));
}

TEST(Gltf, NotesWhatItDoesNotDraw) {
    Document document = triangleDocument();
    document.root["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] = 0;
    document.root["scenes"].push_back({{"nodes", {0}}});
    const Scene scene = load(document.gltf());
    EXPECT_EQ(scene.triangles.size(), 1u);
    EXPECT_THAT(scene.notes, Contains(HasSubstr("COLOR_0")));
    EXPECT_THAT(scene.notes, Contains(HasSubstr("of 2 scenes")));
}

TEST(Gltf, DropsTrianglesThatCannotBeDrawn) {
    constexpr float kNaN = std::numeric_limits<float>::quiet_NaN(),
                    kInfinity = std::numeric_limits<float>::infinity();
    Document document;
    document.addPrimitive({{"POSITION", document.addVec3({0, 0, 0, 1,    0, 0, 0, 1,         0,  //
                                                          0, 0, 0, kNaN, 0, 0, 0, 1,         0,  //
                                                          0, 0, 0, 1,    0, 0, 0, kInfinity, 0,  //
                                                          0, 0, 0, 1,    1, 1, 3, 3,         3})}});
    const Scene scene = load(document.gltf());
    EXPECT_EQ(scene.triangles.size(), 1u);
    EXPECT_EQ(scene.droppedTriangles, 3u);
    EXPECT_THAT(scene.notes, Contains(HasSubstr("dropped 3 triangles")));
    EXPECT_EQ(scene.originM, glm::dvec3(0.5, 0.5, 0)) << "what is dropped does not move the origin";
}

TEST(Gltf, ReplacesNormalsOfNoLength) {
    Document document;
    const int normals = document.addVec3({0, 0, 0, std::numeric_limits<float>::quiet_NaN(), 0, 0, 0, 0, 5});
    document.addPrimitive({{"POSITION", document.addVec3(kTriangle)}, {"NORMAL", normals}});
    for (const glm::vec3& normal : load(document.gltf()).normals) EXPECT_EQ(normal, glm::vec3(0, 0, 1));
}

TEST(Gltf, RefusesBadIndices) {
    Document document;
    const int positions = document.addVec3(kTriangle);
    document.addPrimitive({{"POSITION", positions}});
    json& primitive = document.addPrimitive({{"POSITION", positions}});
    primitive["indices"] = document.add(std::vector<uint16_t>{0, 1, 3}, kUnsignedShort, "SCALAR");
    EXPECT_THAT(
        refusal(document.gltf()),
        HasSubstr(
            "meshes[0].primitives[1].indices: expected indices below the number of vertices, 3, found 3"));
    document.root["accessors"].back()["componentType"] = kByte;
    EXPECT_THAT(refusal(document.gltf()),
                HasSubstr("meshes[0].primitives[1].indices: expected unsigned integers"));
}

TEST(Gltf, RefusesNumbersThatPointNowhere) {
    const auto refuse = [](const std::function<void(json&)>& edit) {
        Document document = triangleDocument();
        edit(document.root);
        return refusal(document.gltf());
    };
    EXPECT_THAT(refuse([](json& r) { r["accessors"][0]["count"] = 4; }),
                HasSubstr("primitives[0].attributes.POSITION: expected 4 elements of 12 bytes"));
    EXPECT_THAT(refuse([](json& r) { r["accessors"][0]["count"] = 4294967295u; }), HasSubstr("POSITION"));
    EXPECT_THAT(refuse([](json& r) { r["accessors"][0]["count"] = 0; }), HasSubstr("POSITION"));
    EXPECT_THAT(refuse([](json& r) { r["accessors"][0]["byteOffset"] = 4; }), HasSubstr("POSITION"));
    EXPECT_THAT(refuse([](json& r) { r["accessors"][0]["byteOffset"] = 18446744073709551612u; }),
                HasSubstr("a.gltf"));
    EXPECT_THAT(refuse([](json& r) { r["accessors"][0]["bufferView"] = 9; }),
                HasSubstr("POSITION: expected a buffer view number below 1, found 9"));
    EXPECT_THAT(refuse([](json& r) { r["accessors"][0]["type"] = "VEC2"; }),
                HasSubstr("POSITION: expected an accessor with 3 components"));
    EXPECT_THAT(refuse([](json& r) { r["accessors"][0]["componentType"] = 5124; }),
                HasSubstr("componentType"));
    EXPECT_THAT(refuse([](json& r) { r["bufferViews"][0]["byteLength"] = 37; }),
                HasSubstr("bufferViews[0]: expected 37 bytes from byte 0, found a buffer of 36 bytes"));
    EXPECT_THAT(refuse([](json& r) { r["bufferViews"][0]["buffer"] = -1; }),
                HasSubstr("bufferViews[0].buffer"));
    EXPECT_THAT(refuse([](json& r) { r["bufferViews"][0]["byteStride"] = 16; }), HasSubstr("POSITION"));
    EXPECT_THAT(refuse([](json& r) { r["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = 5; }),
                HasSubstr("POSITION: expected an accessor number below 1, found 5"));
    EXPECT_THAT(refuse([](json& r) {
                    r["meshes"][0]["primitives"][0]["attributes"] = {{"NORMAL", 0}};
                }),
                HasSubstr("POSITION: expected an accessor, found none"));
    EXPECT_THAT(refuse([](json& r) { r["meshes"][0]["primitives"][0]["indices"] = 3; }),
                HasSubstr("indices"));
    EXPECT_THAT(refuse([](json& r) { r["meshes"][0]["primitives"][0]["material"] = 2; }),
                HasSubstr("primitives[0].material"));
    EXPECT_THAT(refuse([](json& r) { r["meshes"][0]["primitives"][0]["mode"] = 7; }),
                HasSubstr("primitives[0].mode: expected 0 to 6, found 7"));
    EXPECT_THAT(refuse([](json& r) { r["nodes"][0]["mesh"] = 1; }),
                HasSubstr("nodes[0].mesh: expected a mesh number below 1, found 1"));
    EXPECT_THAT(refuse([](json& r) {
                    r["nodes"][0]["matrix"] = {1, 2, 3};
                }),
                HasSubstr("nodes[0].matrix: expected 16 numbers, found 3"));
    EXPECT_THAT(refuse([](json& r) {
                    r["nodes"][0]["rotation"] = {0, 0, 0, 0};
                }),
                HasSubstr("nodes[0].rotation"));
    EXPECT_THAT(refuse([](json& r) { r["nodes"][0]["children"] = {0}; }),
                HasSubstr("nodes[0]: expected one parent and no cycle"));
    EXPECT_THAT(refuse([](json& r) { r["nodes"][0]["children"] = {7}; }), HasSubstr("nodes"));
    EXPECT_THAT(refuse([](json& r) { r["scene"] = 3; }),
                HasSubstr("scene: expected a scene number below 1, found 3"));
    EXPECT_THAT(refuse([](json& r) { r["asset"]["version"] = "1.0"; }),
                HasSubstr("asset.version: expected 2.x, found \"1.0\""));
    EXPECT_THAT(refuse([](json& r) { r["scenes"][0]["nodes"] = json::array(); }),
                HasSubstr("at least one triangle"));
}

TEST(Gltf, NamesAnExtensionItWouldNeed) {
    Document document = triangleDocument();
    document.root["extensionsRequired"] = {"KHR_materials_unlit", "KHR_draco_mesh_compression"};
    EXPECT_THAT(refusal(document.gltf()),
                HasSubstr("extensionsRequired: expected KHR_materials_unlit or KHR_mesh_quantization at "
                          "most, found KHR_draco_mesh_compression"));
    document.root["extensionsRequired"] = {"KHR_materials_unlit"};
    EXPECT_EQ(load(document.gltf()).triangles.size(), 1u);
}

TEST(Gltf, RefusesWhatIsNotGltf) {
    for (const std::string& content :
         {std::string("{"), std::string("[]"), std::string("null"), std::string("hello"),
          std::string("{\"asset\":{}}"), std::string("glTF"),
          std::string("glTF\2\0\0\0\24\0\0\0\xff\xff\xff\xffJSON", 20), std::string("\0\0\0\0", 4)})
        EXPECT_THAT(refusal(content), HasSubstr("a.gltf: ")) << content;
    const std::string nested(100'000, '[');
    EXPECT_THAT(refusal("{\"asset\":{\"version\":\"2.0\"},\"extras\":" + nested),
                HasSubstr("nested at most 200 deep"));
}

TEST(Gltf, RefusesEveryTruncation) {
    const std::string glb = triangleDocument().glb();
    for (size_t length = 0; length < glb.size(); ++length)
        EXPECT_THAT(refusal(glb.substr(0, length), "a.glb"), HasSubstr("a.glb: ")) << length;
    // The header's length cut with the file, so that only the chunks tell.
    for (size_t length = 20; length < glb.size(); ++length) {
        std::string cut = glb.substr(0, length);
        const auto bytes = static_cast<uint32_t>(length);
        std::memcpy(&cut[8], &bytes, 4);
        EXPECT_THAT(refusal(cut, "a.glb"), HasSubstr("a.glb: ")) << length;
    }
    Document document = triangleDocument();
    document.buffer.resize(30);
    EXPECT_THAT(refusal(document.gltf()),
                HasSubstr("bufferViews[0]: expected 36 bytes from byte 0, found a buffer of 30 bytes"));
}

TEST(Gltf, SurvivesDamage) {
    Document document;
    json& primitive =
        document.addPrimitive({{"POSITION", document.addVec3({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 1})}});
    primitive["indices"] = document.add(std::vector<uint16_t>{0, 1, 2, 2, 1, 3}, kUnsignedShort, "SCALAR");
    primitive["material"] = 0;
    document.root["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
    document.root["textures"] = {{{"source", 0}}};
    document.root["images"] = {{{"bufferView", 0}, {"mimeType", "image/png"}}};
    const test::TemporaryFolder folder;
    Random random(9);
    for (const std::string& whole : {document.gltf(), document.glb()})
        for (int round = 0; round < 1500; ++round) {
            std::string content = whole;
            for (uint32_t edits = 1 + random.below(4); edits > 0; --edits) {
                const uint32_t place = random.below(static_cast<uint32_t>(content.size()));
                // Mostly digits, because they lead further than broken JSON does.
                const bool isDigit = content[place] >= '0' && content[place] <= '9';
                content[place] = static_cast<char>(isDigit ? '0' + random.below(10) : random.below(256));
            }
            try {
                test::expectSound(loadScene(folder.write("a.gltf", content)));
            } catch (const InputError&) {
            }
        }
}

}  // namespace
}  // namespace curvewall
