#include "renderer/image_source.h"

#include "calibration/errors.h"
#include "renderer/planar_source.h"
#include "renderer/request_limits.h"
#include "tests/support/random_numbers.h"
#include "tests/support/test_projections.h"
#include "tests/support/test_walls.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace curvewall {
namespace {

// Every pixel looks somewhere else, all around.
FunctionRays scatteredRays(glm::ivec2 sizePx) {
    return {[](glm::dvec2 px) -> std::optional<glm::dvec3> {
                test::Random random(static_cast<uint32_t>(px.x * 1000 + px.y));
                return random.direction();
            },
            sizePx};
}

// A display that shows a screen squarely, the eye far from its middle, turned anyhow.
Wall obliqueWall(glm::ivec2 sizePx) {
    const glm::dvec3 right = glm::normalize(glm::dvec3(1, 0.3, 0.2));
    const glm::dvec3 up = glm::normalize(glm::cross(right, glm::dvec3(0.1, 0.2, -1)));
    const glm::dvec3 corner(-0.5, -0.2, -1);
    const PlanarScreen screen{corner, corner + 2.0 * right, corner + 1.5 * up};
    return wallOf(std::make_shared<PlanarProjection>(screen, glm::dvec3(0), sizePx), sizePx);
}

void expectAllRaysInside(const ImageSource& source, const PixelRays& rays) {
    const auto places = sourcePlaces(source, rays);
    size_t index = 0;
    for (int y = 0; y < rays.sizePx().y; ++y) {
        for (int x = 0; x < rays.sizePx().x; ++x, ++index) {
            const glm::vec4 place = places[index];
            ASSERT_EQ(place.w, rays.has({x, y}) ? 1 : 0);
            if (place.w == 0) continue;
            const SourceFace& face = source.faces.at(static_cast<size_t>(place.z));
            const glm::dvec3 ray = glm::normalize(rays.at({x, y}));
            ASSERT_LT(glm::distance(glm::normalize(face.ray({place.x, place.y})), ray), 2e-6);
            for (int axis = 0; axis < 2; ++axis) {
                ASSERT_GT(place[axis], kApronPx - 1e-3f);
                ASSERT_LT(place[axis], static_cast<float>(face.sizePx[axis] - kApronPx) + 1e-3f);
            }
        }
    }
}

TEST(ImageSource, RaysMeetTheCubeWithinItsFaces) {
    const FunctionRays rays = scatteredRays({200, 100});
    const ImageSource source = cubeSource(rays, 64);
    ASSERT_EQ(source.faces.size(), 6u);
    EXPECT_EQ(source.faces[0].sizePx, glm::ivec2(64 + 2 * kApronPx));
    expectAllRaysInside(source, rays);
}

TEST(ImageSource, FacesThatNoRayMeetsAreLeftOut) {
    const Wall wall = test::planarWall({400, 300}, 80);
    EXPECT_EQ(cubeSource(PixelRays(*wall.displays[0].projection, {400, 300}), 64).faces.size(), 1u);
    const FunctionRays nothing([](glm::dvec2) { return std::nullopt; }, {8, 8});
    EXPECT_TRUE(cubeSource(nothing, 64).faces.empty());
    EXPECT_TRUE(planarSource(nothing, 0).faces.empty());
}

TEST(ImageSource, PicturesAreSeenFromTheFront) {
    const FunctionRays rays = scatteredRays({50, 50});
    for (const SourceFace& face : cubeSource(rays, 64).faces)
        EXPECT_LT(glm::distance(glm::cross(face.axes.right, face.axes.down), face.axes.ahead), 1e-12);
}

TEST(ImageSource, TheMeshOfAFaceShowsTheSameAsItsTexels) {
    test::Random random(2);
    const Wall oblique = obliqueWall({40, 30});
    std::vector<SourceFace> faces = cubeSource(scatteredRays({50, 50}), 256).faces;
    faces.push_back(planarSource(PixelRays(*oblique.displays[0].projection, {40, 30}), 0).faces.at(0));
    for (const SourceFace& face : faces) {
        const PieceMesh mesh = faceMesh(face, 2.5);
        ASSERT_EQ(mesh.pieces.size(), 1u);
        for (int i = 0; i < 100; ++i) {
            const glm::dvec2 place =
                glm::dvec2(random.uniform(0, 1), random.uniform(0, 1)) * glm::dvec2(face.sizePx);
            const glm::dvec3 seen = mesh.pieces[0].screenFromRay * face.ray(place);
            EXPECT_GT(seen.z, 0);
            EXPECT_LT(glm::distance(glm::dvec2(seen) / seen.z, place), 1e-9);
        }
    }
}

TEST(ImageSource, ErrorFallsWithTheFaceSize) {
    const Wall wall = test::fullCylinderWall({400, 300});
    const PixelRays rays(*wall.displays[0].projection, {400, 300});
    const auto errorPx = [&](int faceSizePx) {
        return sourceError(cubeSource(rays, faceSizePx), wall.displays[0], rays).maxPx;
    };
    EXPECT_NEAR(errorPx(256) / errorPx(1024), 4, 0.4);
}

TEST(PlanarSource, AScreenSeenObliquelyNeedsHardlyMoreTexelsThanItHasPixels) {
    // Parallel to the screen one texel is one pixel.
    const glm::ivec2 sizePx(400, 300);
    const Wall wall = obliqueWall(sizePx);
    const PixelRays rays(*wall.displays[0].projection, sizePx);
    const ImageSource source = planarSource(rays, 0);
    ASSERT_EQ(source.faces.size(), 1u);
    expectAllRaysInside(source, rays);
    const glm::ivec2 inside = source.faces[0].sizePx - 2 * kApronPx;
    EXPECT_LT(inside.x * inside.y, 1.03 * sizePx.x * sizePx.y);
    EXPECT_EQ(source.faceSizePx, std::max(source.faces[0].sizePx.x, source.faces[0].sizePx.y));
}

TEST(PlanarSource, HoldsEveryRayAtTheSizeAskedFor) {
    for (const double arcRad : {0.5, 1.5, 2.6}) {
        const Wall wall = test::cylinderWall({2, arcRad, 2, {}, {}}, {}, {300, 200});
        const PixelRays rays(*wall.displays[0].projection, {300, 200});
        for (const int sizePx : {0, 16, 500}) {
            const ImageSource source = planarSource(rays, sizePx);
            expectAllRaysInside(source, rays);
            if (sizePx > 0) {
                EXPECT_EQ(source.faceSizePx, sizePx);
            }
        }
    }
}

TEST(PlanarSource, RefusesWhatNoPlaneHolds) {
    // 170 degrees across are the limit.
    for (const double arcRad : {3.0, test::kPi, 2 * test::kPi}) {
        const Wall wall = test::cylinderWall({2, arcRad, 1, {}, {}}, {}, {300, 200});
        EXPECT_THROW(planarSource(PixelRays(*wall.displays[0].projection, {300, 200}), 0), UsageError);
    }
    EXPECT_THROW(planarSource(scatteredRays({64, 64}), 0), UsageError);
}

TEST(PlanarSource, GrowsNoLargerThanTheLimit) {
    const Wall wall = test::cylinderWall({2, 2.9, 1, {}, {}}, {}, {3000, 20});
    const ImageSource source = planarSource(PixelRays(*wall.displays[0].projection, {3000, 20}), 0);
    EXPECT_LE(source.faceSizePx, kMostFacePx);
}

}  // namespace
}  // namespace curvewall
