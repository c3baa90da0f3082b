#include "calibration/errors.h"
#include "renderer/scene/city.h"
#include "renderer/scene/load_scene.h"
#include "tests/renderer/scene_checks.h"

#include <glm/common.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <string_view>

namespace curvewall {
namespace {

uint64_t hashOf(const Scene& scene) {
    uint64_t hash = 14695981039346656037u;
    const auto add = [&](const auto& values) {
        const std::string_view bytes(reinterpret_cast<const char*>(values.data()),
                                     values.size() * sizeof(values[0]));
        for (const char byte : bytes) hash = (hash ^ static_cast<uint8_t>(byte)) * 1099511628211u;
    };
    add(scene.positions);
    add(scene.normals);
    add(scene.uvs);
    add(scene.triangles);
    for (const MaterialRange& range : scene.ranges)
        hash = hash * 31 + range.material * 7 + range.triangleCount;
    for (const Texture& texture : scene.textures)
        for (const MipLevel& level : texture.levels) add(level.texels);
    return hash;
}

// To the nearest point of a triangle (Ericson, Real-Time Collision Detection, 5.1.5).
double distanceToTriangle(glm::dvec3 p, glm::dvec3 a, glm::dvec3 b, glm::dvec3 c) {
    const glm::dvec3 normal = glm::normalize(glm::cross(b - a, c - a));
    const auto isInside = [&](glm::dvec3 from, glm::dvec3 to) {
        return glm::dot(glm::cross(to - from, p - from), normal) >= 0;
    };
    if (isInside(a, b) && isInside(b, c) && isInside(c, a)) return std::abs(glm::dot(p - a, normal));
    const auto toSegment = [&](glm::dvec3 from, glm::dvec3 to) {
        const double t = glm::clamp(glm::dot(p - from, to - from) / glm::dot(to - from, to - from), 0.0, 1.0);
        return glm::distance(p, from + t * (to - from));
    };
    return std::min({toSegment(a, b), toSegment(b, c), toSegment(c, a)});
}

bool hits(glm::dvec3 origin, glm::dvec3 ray, glm::dvec3 a, glm::dvec3 b, glm::dvec3 c) {
    const auto side = [&](glm::dvec3 u, glm::dvec3 v) {
        return glm::dot(ray, glm::cross(u - origin, v - origin));
    };
    const double ab = side(a, b), bc = side(b, c), ca = side(c, a);
    const bool isThrough = (ab >= 0 && bc >= 0 && ca >= 0) || (ab <= 0 && bc <= 0 && ca <= 0);
    const glm::dvec3 normal = glm::cross(b - a, c - a);
    return isThrough && glm::dot(a - origin, normal) * glm::dot(ray, normal) > 0;
}

bool hitsAnything(const Scene& scene, glm::dvec3 origin, glm::dvec3 ray) {
    return std::any_of(scene.triangles.begin(), scene.triangles.end(), [&](const glm::uvec3& t) {
        return hits(origin, ray, scene.positions[t.x], scene.positions[t.y], scene.positions[t.z]);
    });
}

struct CitySize {
    uint32_t triangles;
    uint32_t seed;
};

class CityOfAnySize : public testing::TestWithParam<CitySize> {};

TEST_P(CityOfAnySize, HasExactlyTheTrianglesAskedForAndIsSound) {
    const Scene city = makeCity(GetParam().triangles, GetParam().seed);
    EXPECT_EQ(city.triangles.size(), GetParam().triangles);
    test::expectSound(city);
    EXPECT_EQ(test::cornersAgainstWinding(city), 0u);
}

INSTANTIATE_TEST_SUITE_P(Sizes, CityOfAnySize,
                         testing::Values(CitySize{1000, 1}, CitySize{1001, 1}, CitySize{1000, 77},
                                         CitySize{5799, 3}, CitySize{7000, 4}, CitySize{35'000, 1},
                                         CitySize{34'999, 1}, CitySize{35'000, 2},
                                         CitySize{35'000, 4294967295u}, CitySize{200'000, 1},
                                         CitySize{200'000, 5}));

TEST(City, IsTheSameEveryTime) {
    EXPECT_EQ(hashOf(makeCity(35'000, 1)), hashOf(makeCity(35'000, 1)));
    EXPECT_EQ(hashOf(makeCity(35'000, 1)), hashOf(loadScene("city")));
    EXPECT_NE(hashOf(makeCity(35'000, 1)), hashOf(makeCity(35'000, 2)));
}

TEST(City, UsesAll14MaterialsTwoSided) {
    const Scene city = loadScene("city");
    EXPECT_EQ(city.materials.size(), 14u);
    EXPECT_EQ(city.ranges.size(), 14u);
    for (const Material& material : city.materials) {
        EXPECT_TRUE(material.doubleSided);
        EXPECT_LT(material.alphaCutoff, 0);
    }
    EXPECT_EQ(city.textures.size(), 13u) << "only the lane markings have no texture";
}

TEST(City, StandsClearOfItsDefaultCamera) {
    for (const uint32_t seed : {1u, 2u, 3u, 4u, 5u}) {
        const Scene city = makeCity(kDefaultCityTriangles, seed);
        EXPECT_EQ(city.defaultCamera.positionM, glm::dvec3(0, 8, 0));
        double nearest = std::numeric_limits<double>::infinity();
        for (const glm::uvec3& t : city.triangles)
            nearest = std::min(nearest, distanceToTriangle(city.defaultCamera.positionM, city.positions[t.x],
                                                           city.positions[t.y], city.positions[t.z]));
        EXPECT_GT(nearest, 2.0) << "seed " << seed;
        EXPECT_FALSE(hitsAnything(city, city.defaultCamera.positionM, {0, 1, 0})) << "inside something";
    }
}

TEST(City, HasGroundAndHillsAllAround) {
    const Scene city = loadScene("city");
    const glm::dvec3 eye = city.defaultCamera.positionM;
    for (int degrees = 0; degrees < 360; degrees += 3) {
        const double angle = degrees * 0.017453292519943295;
        for (const double slope : {-5.0, -0.3, -0.03, -0.001, 0.005})
            EXPECT_TRUE(hitsAnything(city, eye, {std::sin(angle), slope, -std::cos(angle)}))
                << degrees << " degrees, slope " << slope;
    }
}

TEST(City, GroundIsAtHeightZero) {
    const Scene city = makeCity(200'000, 1);
    float lowest = 1;
    for (const glm::vec3& p : city.positions) lowest = std::min(lowest, p.y);
    EXPECT_EQ(lowest, 0);
}

TEST(City, GrowsOutwardsWithItsTriangles) {
    const auto asphaltWidth = [](const Scene& city) {
        float low = 0, high = 0;
        for (const MaterialRange& range : city.ranges) {
            if (city.materials[range.material].name != "asphalt") continue;
            for (uint32_t i = 0; i < range.triangleCount; ++i)
                for (glm::length_t k = 0; k < 3; ++k) {
                    const float x = city.positions[city.triangles[range.firstTriangle + i][k]].x;
                    low = std::min(low, x);
                    high = std::max(high, x);
                }
        }
        return high - low;
    };
    // 400,000 triangles are 11 times as many, so about 3.4 times as wide.
    const float ratio = asphaltWidth(makeCity(400'000)) / asphaltWidth(makeCity(35'000));
    EXPECT_GT(ratio, 2.5f);
    EXPECT_LT(ratio, 4.5f);
}

TEST(City, BuildingsAre8To60MetresHigh) {
    float highest = 0;
    const Scene city = makeCity(200'000, 1);
    for (const MaterialRange& range : city.ranges) {
        if (city.materials[range.material].name != "glass") continue;
        for (uint32_t i = 0; i < range.triangleCount; ++i)
            highest = std::max(highest, city.positions[city.triangles[range.firstTriangle + i].z].y);
    }
    EXPECT_GT(highest, 40);
    EXPECT_LT(highest, 62);
}

}  // namespace
}  // namespace curvewall
