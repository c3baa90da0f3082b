#pragma once
// Collects the city's triangles by material.

#include "renderer/scene/city_materials.h"
#include "renderer/scene/scene.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace curvewall {

struct Corner {
    glm::vec3 positionM;
    glm::vec2 uv;
};

// An upright box by its lower and upper corner.
struct Box {
    glm::vec3 lowM;
    glm::vec3 highM;
};

enum class BoxFaces { sides, sidesAndTop, all };  // 8, 10 and 12 triangles

// Corners run counter-clockwise seen from the front. Faces are flat and share no vertices unless told
// otherwise.
class MeshBuilder {
public:
    explicit MeshBuilder(size_t expectedTriangles);

    size_t triangleCount() const { return triangleCount_; }

    void triangle(CityMaterial material, const Corner& a, const Corner& b, const Corner& c);
    void quad(CityMaterial material, const Corner& a, const Corner& b, const Corner& c, const Corner& d);
    // Triangles of a round body, with a normal for each corner.
    void smoothBody(CityMaterial material, std::span<const Corner> corners,
                    std::span<const glm::vec3> normals, std::span<const glm::uvec3> triangles);

    void paintedTriangle(Paint paint, glm::vec3 a, glm::vec3 b, glm::vec3 c);
    void paintedQuad(Paint paint, glm::vec3 a, glm::vec3 b, glm::vec3 c, glm::vec3 d);
    void paintedBox(Paint paint, const Box& box, BoxFaces faces) { paintedFrustum(paint, box, 1, faces); }
    // A box whose top is scaled about its middle.
    void paintedFrustum(Paint paint, const Box& box, float topScale, BoxFaces faces);

    // Moves the triangles, sorted by material, into the scene.
    void moveInto(Scene& scene);

    // rollBack undoes what was added since the mark was taken.
    struct Mark {
        size_t vertices = 0;
        size_t triangleCount = 0;
        std::array<size_t, kCityMaterials> triangles{};
    };
    Mark mark() const;
    void rollBack(const Mark& mark);

private:
    uint32_t addCorners(std::span<const Corner> corners, glm::vec3 normal);
    void addTriangle(CityMaterial material, glm::uvec3 corners);

    std::vector<glm::vec3> positions_;
    std::vector<glm::vec3> normals_;
    std::vector<glm::vec2> uvs_;
    std::array<std::vector<glm::uvec3>, kCityMaterials> triangles_;
    size_t triangleCount_ = 0;
};

}  // namespace curvewall
