#pragma once
// A scene as the renderers see it: triangles, points and lines, materials, textures. Value type, no GL.

#include "renderer/camera.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace curvewall {

// glTF sampler wrap modes.
enum class Wrap { repeat, clampToEdge, mirroredRepeat };

struct MipLevel {
    glm::ivec2 sizePx{0};
    std::vector<glm::u8vec4> texels;  // sRGB colour, linear alpha; row 0 is at v = 0 (glTF: the top row)
};

// Mip levels are made once, on the CPU, so that every method filters the same texels.
struct Texture {
    std::string name;
    Wrap wrapS = Wrap::repeat;
    Wrap wrapT = Wrap::repeat;
    std::vector<MipLevel> levels;  // full chain, level 0 first
};

// How a surface mixes with what lies behind it.
enum class Blending {
    none,      // it hides it
    alpha,     // color * alpha + behind * (1 - alpha)
    additive,  // color * alpha + behind
};

struct Material {
    std::string name;
    glm::vec4 baseColor{1};  // linear light, multiplies the texture
    int texture = -1;        // index into Scene::textures, or -1
    float alphaCutoff = -1;  // fragments with less alpha are discarded; negative: none are
    Blending blending = Blending::none;
    bool doubleSided = true;  // otherwise triangles seen from behind are not drawn
    bool unlit = false;       // KHR_materials_unlit
};

// A run of triangles that share a material.
struct MaterialRange {
    uint32_t material = 0;
    uint32_t firstTriangle = 0;
    uint32_t triangleCount = 0;
};

// A run of points or of lines that share a material.
struct StrokeRange {
    uint32_t material = 0;
    uint32_t first = 0;
    uint32_t count = 0;
};

struct Scene {
    std::string name;
    glm::dvec3 originM{0};  // subtracted in double, so that a scene far away keeps its float precision
    // One entry a vertex; positions are metres relative to originM, normals have length one.
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;
    std::vector<glm::vec2> uvs;
    std::vector<glm::uvec3> triangles;  // counter-clockwise seen from the front
    std::vector<MaterialRange> ranges;  // in triangle order, covering all triangles
    // Drawn as wide as renderer/strokes.h says, whatever their distance. Those whose vertices have no normals
    // in the file have unlit materials.
    std::vector<uint32_t> points;
    std::vector<glm::uvec2> lines;
    std::vector<StrokeRange> pointRanges, lineRanges;  // in order, covering all
    std::vector<Material> materials;
    std::vector<Texture> textures;
    Camera defaultCamera;
    size_t droppedTriangles = 0;     // of the file's: non-finite or without area, so nothing shows them
    std::vector<std::string> notes;  // what the file holds that is not drawn, for the user
};

using ScenePtr = std::shared_ptr<const Scene>;

}  // namespace curvewall
