#include "calibration/pieces/facet_following.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <array>
#include <limits>

namespace curvewall {
namespace {

// A projector beside a flat wall two metres ahead: the point that it lights with a pixel, from an eye.
glm::dvec3 keystone(glm::dvec2 px, glm::dvec3 eyeM) {
    const double w = 1 + 0.004 * px.x + 0.002 * px.y;
    return glm::dvec3((0.03 * px.x - 1) / w, (0.9 - 0.03 * px.y) / w, -2) - eyeM;
}
// How much farther or nearer than the wall exact facets are.
double weight(glm::dvec2 px) { return 1 + 0.004 * px.x + 0.002 * px.y; }

struct Keystone {
    Keystone() {
        PieceGrid grid{{60, 60}, 3, 3, {}};
        for (int row = 0; row <= 3; ++row)
            for (int column = 0; column <= 3; ++column) {
                const glm::dvec2 s(20 * column, 20 * row);
                grid.vertices.push_back({weight(s) * keystone(s, {}), s});
                motion.addVertex(std::array<Motion::Term, 1>{{{motionCount++, 1}}});
                rays.push_back(keystone(s, {}));
                movedRays.push_back(keystone(s, kEyeM));
            }
        mesh = meshFromGrid(grid, false);
    }
    double errorPx(glm::dvec3 eyeM) const {
        double largest = 0;
        for (const Piece& piece : mesh.pieces) {
            glm::dvec2 px(0);
            for (uint32_t i = 0; i < 3; ++i) px += mesh.vertices[piece.vertices[i]].s / 3.0;
            const glm::dvec3 h = piece.screenFromRay * keystone(px, eyeM);
            largest = std::max(largest, glm::distance(glm::dvec2(h) / h.z, px));
        }
        return largest;
    }

    static constexpr glm::dvec3 kEyeM{0.4, -0.2, 0.3};
    uint32_t motionCount = 0;
    PieceMesh mesh;
    Motion motion;
    std::vector<glm::dvec3> rays, movedRays;
};

TEST(FacetFollowing, IsExactWhereADisplayIsAHomographyWhateverTheDistancesOfItsFacets) {
    Keystone display;
    ASSERT_LT(display.errorPx({}), 1e-9);
    ASSERT_GT(display.errorPx(Keystone::kEyeM), 1);
    follow(display.mesh, display.motion, display.rays, display.movedRays);
    EXPECT_LT(display.errorPx(Keystone::kEyeM), 1e-6);
}

TEST(FacetFollowing, VerticesInHolesGoWithTheirNeighbours) {
    Keystone display;
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    display.rays[0] = display.movedRays[0] = display.movedRays[1] = glm::dvec3(kNone);
    const PieceMesh before = display.mesh;
    follow(display.mesh, display.motion, display.rays, display.movedRays);
    for (size_t v : {0, 1}) {
        const glm::dvec3 moved = display.mesh.vertices[v].m - before.vertices[v].m;
        EXPECT_LT(glm::distance(moved, -Keystone::kEyeM), 0.2 * glm::length(Keystone::kEyeM));
    }
}

TEST(FacetFollowing, VerticesThatMayNotMoveAloneKeepTheirPlace) {
    Keystone display;
    Motion motion;  // vertex 1 half way between 0 and 2
    for (uint32_t v = 0; v < display.mesh.vertices.size(); ++v) {
        if (v == 1)
            motion.addVertex(std::array<Motion::Term, 2>{{{0, 0.5}, {1, 0.5}}});
        else
            motion.addVertex(std::array<Motion::Term, 1>{{{v == 0 ? 0 : v - 1, 1}}});
    }
    auto& vertices = display.mesh.vertices;
    vertices[1].m = 0.5 * (vertices[0].m + vertices[2].m);
    follow(display.mesh, motion, display.rays, display.movedRays);
    EXPECT_LT(glm::distance(vertices[1].m, 0.5 * (vertices[0].m + vertices[2].m)), 1e-12);
}

}  // namespace
}  // namespace curvewall
