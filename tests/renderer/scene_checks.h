#pragma once
// What holds for every scene, whatever it was made from.

#include "renderer/scene/scene.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

namespace curvewall::test {

inline bool isFinite(glm::vec3 v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

// Twice the area times the unit normal, in double: the products of floats do not round.
inline glm::dvec3 crossOf(const Scene& scene, const glm::uvec3& t) {
    const glm::dvec3 a(scene.positions[t.x]), b(scene.positions[t.y]), c(scene.positions[t.z]);
    return glm::cross(b - a, c - a);
}

inline void expectSound(const Scene& scene) {
    ASSERT_EQ(scene.normals.size(), scene.positions.size());
    ASSERT_EQ(scene.uvs.size(), scene.positions.size());
    size_t badVertices = 0, badTriangles = 0;
    for (size_t i = 0; i < scene.positions.size(); ++i)
        if (!isFinite(scene.positions[i]) || !(std::abs(glm::length(scene.normals[i]) - 1) < 1e-5f) ||
            !std::isfinite(scene.uvs[i].x) || !std::isfinite(scene.uvs[i].y))
            ++badVertices;
    for (const glm::uvec3& t : scene.triangles)
        if (t.x >= scene.positions.size() || t.y >= scene.positions.size() || t.z >= scene.positions.size() ||
            crossOf(scene, t) == glm::dvec3(0))
            ++badTriangles;
    EXPECT_EQ(badVertices, 0u);
    EXPECT_EQ(badTriangles, 0u);

    uint32_t next = 0;
    for (const MaterialRange& range : scene.ranges) {
        EXPECT_EQ(range.firstTriangle, next);
        EXPECT_GT(range.triangleCount, 0u);
        EXPECT_LT(range.material, scene.materials.size());
        next += range.triangleCount;
    }
    EXPECT_EQ(next, scene.triangles.size());
    const auto expectCovered = [&](const std::vector<StrokeRange>& runs, size_t count) {
        uint32_t end = 0;
        for (const StrokeRange& run : runs) {
            EXPECT_EQ(run.first, end);
            EXPECT_GT(run.count, 0u);
            EXPECT_LT(run.material, scene.materials.size());
            end += run.count;
        }
        EXPECT_EQ(end, count);
    };
    expectCovered(scene.pointRanges, scene.points.size());
    expectCovered(scene.lineRanges, scene.lines.size());
    for (const uint32_t point : scene.points) EXPECT_LT(point, scene.positions.size());
    for (const glm::uvec2& line : scene.lines) {
        ASSERT_LT(std::max(line.x, line.y), scene.positions.size());
        EXPECT_NE(scene.positions[line.x], scene.positions[line.y]);
    }
    for (const Material& material : scene.materials)
        EXPECT_LT(material.texture, static_cast<int>(scene.textures.size()));
}

// Corners whose normal looks away from the front of their triangle.
inline size_t cornersAgainstWinding(const Scene& scene) {
    size_t count = 0;
    for (const glm::uvec3& t : scene.triangles)
        for (const uint32_t corner : {t.x, t.y, t.z})
            if (!(glm::dot(crossOf(scene, t), glm::dvec3(scene.normals[corner])) > 0)) ++count;
    return count;
}

// A folder of its own for each test, gone afterwards.
class TemporaryFolder {
public:
    TemporaryFolder() {
        const testing::TestInfo& test = *testing::UnitTest::GetInstance()->current_test_info();
        path_ = std::filesystem::path(testing::TempDir()) /
                ("curvewall-" + std::string(test.test_suite_name()) + "-" + test.name());
        std::filesystem::remove_all(path_);
        std::filesystem::create_directories(path_);
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    ~TemporaryFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }

    std::string write(const std::string& name, const std::string& content) const {
        std::ofstream(path_ / name, std::ios::binary) << content;
        return (path_ / name).string();
    }
    std::string pathOf(const std::string& name) const { return (path_ / name).string(); }

private:
    std::filesystem::path path_;
};

// The message of the exception that `function` throws, or "no exception".
template <class Exception, class Function>
std::string messageOf(Function function) {
    try {
        function();
    } catch (const Exception& e) {
        return e.what();
    }
    return "no exception";
}

}  // namespace curvewall::test
