#include "renderer/image_source.h"

#include "calibration/errors.h"
#include "calibration/projections/lens_projection.h"
#include "calibration/projections/radial_lens.h"
#include "renderer/cube_source.h"
#include "renderer/lookup_mesh.h"
#include "renderer/planar_source.h"
#include "renderer/request_limits.h"
#include "tests/support/random_numbers.h"
#include "tests/support/test_projections.h"
#include "tests/support/test_walls.h"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <gtest/gtest.h>

#include <array>
#include <cmath>

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
                ASSERT_GT(place[axis], static_cast<float>(source.apronPx) - 1e-3f);
                ASSERT_LT(place[axis], static_cast<float>(face.sizePx[axis] - source.apronPx) + 1e-3f);
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
        const ImageSource source = cubeSource(rays, faceSizePx);
        return sourceError(source, sourcePlaces(source, rays), wall.displays[0]).maxPx;
    };
    EXPECT_NEAR(errorPx(256) / errorPx(1024), 4, 0.4);
}

// Equal angles from the axis to pixels, `fovDeg` across the circle.
Wall domeWall(glm::ivec2 sizePx, double fovDeg, glm::dvec3 yawPitchRollDeg = {}) {
    const glm::dvec3 turn = glm::radians(yawPitchRollDeg);
    const LensPtr lens = circularLens({}, glm::radians(fovDeg), sizePx);
    return wallOf(std::make_shared<LensProjection>(lens, Orientation{turn.x, turn.y, turn.z}), sizePx);
}

TEST(CubeSource, AHalfDomeHasAWholeFaceAndFourHalves) {
    // As in figure 10 (b) of Gascuel et al., Fast Non-Linear Projections using Graphics Hardware, 2008:
    // 512 x 512 pixels and four times 512 x 256.
    const glm::ivec2 sizePx(300, 300);
    for (const glm::dvec3 turnDeg : {glm::dvec3(0), {30, 90, 0}, {-71, 13, 45}}) {
        const Wall wall = domeWall(sizePx, 180, turnDeg);
        const PixelRays rays(*wall.displays[0].projection, sizePx);
        const ImageSource source = hemicubeSource(rays, 512);
        ASSERT_EQ(source.faces.size(), 5u);
        std::array<int, 2> counts{};
        for (const SourceFace& face : source.faces) {
            const glm::ivec2 inside = face.sizePx - 2 * kApronPx;
            const int shorter = std::min(inside.x, inside.y), longer = std::max(inside.x, inside.y);
            // The outermost pixels' centres end a little before the border.
            EXPECT_NEAR(longer, 512, 6);
            ++counts[std::abs(shorter - 512) <= 6 ? 0 : 1];
            if (shorter < 500) {
                EXPECT_NEAR(shorter, 256, 4);
            }
        }
        EXPECT_EQ(counts, (std::array<int, 2>{1, 4}));
        expectAllRaysInside(source, rays);
    }
}

TEST(CubeSource, HasAsManyFacesAsTheDisplaySees) {
    const glm::ivec2 sizePx(240, 240);
    const auto facesOf = [&](const Wall& wall) {
        return cubeSource(PixelRays(*wall.displays[0].projection, wall.displays[0].sizePx), 64).faces.size();
    };
    // A band around the eye meets neither the ceiling nor the floor.
    EXPECT_EQ(facesOf(test::cylinderWall({2, 2 * test::kPi, 1, {}, {}}, {}, {360, 60})), 4u);
    // The corners of the face behind are the root of a third from the axis: five faces end there.
    const double fiveDeg = 2 * glm::degrees(std::acos(-1 / std::sqrt(3.0)));
    EXPECT_EQ(facesOf(domeWall(sizePx, 180)), 5u);
    EXPECT_EQ(facesOf(domeWall(sizePx, fiveDeg - 4)), 5u);
    EXPECT_EQ(facesOf(domeWall(sizePx, fiveDeg + 4)), 6u);
}

TEST(CubeSource, AHemicubeHoldsAHalfSpaceAndNoMore) {
    const glm::ivec2 sizePx(200, 200);
    const auto hemicubeOf = [&](const Wall& wall) {
        return hemicubeSource(PixelRays(*wall.displays[0].projection, wall.displays[0].sizePx), 64);
    };
    EXPECT_NO_THROW(hemicubeOf(domeWall(sizePx, 180)));
    EXPECT_THROW(hemicubeOf(domeWall(sizePx, 184)), UsageError);
    EXPECT_NO_THROW(hemicubeOf(test::cylinderWall({2, 3.0, 1, {}, {}}, {}, {300, 200})));
    EXPECT_THROW(hemicubeOf(test::cylinderWall({2, 3.3, 1, {}, {}}, {}, {300, 200})), UsageError);
    EXPECT_THROW(hemicubeOf(test::fullCylinderWall({300, 200})), UsageError);
}

TEST(CubeSource, AHemicubeTurnsToAnAxisThatHoldsADisplaySeenFromTheSide) {
    // Most pixels lie to the right of the eye, and leave the left end behind their mean direction.
    const Wall wall = test::cylinderWall({2, 2.6, 1, {}, {}}, {-1.2, 0, -0.45}, {300, 200});
    const PixelRays rays(*wall.displays[0].projection, {300, 200});
    glm::dvec3 mean(0);
    double least = 1;
    for (int x = 0; x < 300; ++x)
        for (int y = 0; y < 200; ++y) mean += glm::normalize(rays.at({x, y}));
    for (int x = 0; x < 300; ++x)
        least = std::min(least, glm::dot(glm::normalize(rays.at({x, 100})), glm::normalize(mean)));
    ASSERT_LT(least, -0.01) << "what is tested is that the mean alone does not hold it";
    expectAllRaysInside(hemicubeSource(rays, 64), rays);
}

TEST(CubeSource, HoldsEveryRayWhateverWayTheDisplayLooks) {
    test::Random random(7);
    for (int i = 0; i < 40; ++i) {
        const glm::ivec2 sizePx(120, 90);
        const Wall wall = domeWall(
            sizePx, random.uniform(20, 330),
            glm::dvec3(random.uniform(-180, 180), random.uniform(-90, 90), random.uniform(-180, 180)));
        const PixelRays rays(*wall.displays[0].projection, sizePx);
        for (const int faceSizePx : {0, 50}) {
            expectAllRaysInside(cubeSource(rays, faceSizePx), rays);
            expectAllRaysInside(withLevels(cubeSource(rays, faceSizePx), rays), rays);
        }
    }
}

TEST(CubeSource, ACubeTurnsToANarrowDisplay) {
    // Across an edge, or even a corner, of the cube along the wall.
    const glm::ivec2 sizePx(120, 120);
    for (const glm::dvec3 turnDeg : {glm::dvec3(45, 0, 0), {30, 35, 0}, {45, 35.26, 20}, {0, 90, 0}}) {
        const Wall wall = domeWall(sizePx, 80, turnDeg);
        const PixelRays rays(*wall.displays[0].projection, sizePx);
        EXPECT_EQ(cubeSource(rays, 0).faces.size(), 1u);
    }
}

TEST(CubeSource, AFaceEndsWhereTheDisplayDoes) {
    // A strip of 90 by 10 degrees on a face of 400 texels.
    const glm::ivec2 sizePx(200, 20);
    const Wall wall = test::planarWall(sizePx, 90);
    const ImageSource source = cubeSource(PixelRays(*wall.displays[0].projection, sizePx), 400);
    ASSERT_EQ(source.faces.size(), 1u);
    EXPECT_EQ(source.faces[0].sizePx, glm::ivec2(398, 38) + 2 * kApronPx);
    EXPECT_EQ(texelCountOf(source), (398u + 4) * (38 + 4));
}

TEST(SourceLevels, AreAsManyAsTheTexelsOfAPixelHalve) {
    const Wall wall = test::planarWall({64, 64}, 90);
    const PixelRays rays(*wall.displays[0].projection, {64, 64});
    for (const auto& [faceSizePx, levels] :
         {std::pair{32, 0}, {64, 0}, {65, 1}, {128, 1}, {256, 2}, {300, 3}, {2048, 5}, {8192, 5}}) {
        const ImageSource source = withLevels(cubeSource(rays, faceSizePx), rays);
        EXPECT_EQ(source.levels, levels) << faceSizePx;
        EXPECT_EQ(source.apronPx, std::max(kApronPx, 2 << levels));
        const glm::ivec2 layerPx = layerSizeOf(source);
        EXPECT_EQ(layerPx % (1 << levels), glm::ivec2(0));
        EXPECT_TRUE(glm::all(glm::greaterThanEqual(layerPx, source.faces[0].sizePx)));
    }
}

TEST(SourceGradients, AreTheDerivativesOfThePlacesAcrossBordersOfFacesToo) {
    const glm::ivec2 sizePx(200, 200);
    const Wall wall = domeWall(sizePx, 300, {20, 30, 40});
    const Projection& projection = *wall.displays[0].projection;
    const PixelRays rays(projection, sizePx);
    const ImageSource source = cubeSource(rays, 100);
    const auto gradients = sourceGradients(source, rays);
    size_t index = 0, atBorders = 0;
    for (int y = 0; y < sizePx.y; ++y) {
        for (int x = 0; x < sizePx.x; ++x, ++index) {
            if (glm::distance(centreOf({x, y}), glm::dvec2(100)) > 97) continue;
            const size_t index2 = faceOf(source, rays.at({x, y}));
            const SourceFace& face = source.faces[index2];
            const auto placeAt = [&](glm::dvec2 px) { return face.place(*projection.unproject(px)); };
            constexpr double kStepPx = 1e-4;
            const glm::dvec2 px = centreOf({x, y});
            const glm::dvec2 right = (placeAt(px + glm::dvec2(kStepPx, 0)) - placeAt(px)) / kStepPx;
            const glm::dvec2 down = (placeAt(px + glm::dvec2(0, kStepPx)) - placeAt(px)) / kStepPx;
            const glm::vec4 gradient = gradients[index];
            ASSERT_LT(glm::distance(glm::dvec2(gradient.x, gradient.y), right), 0.02 * glm::length(right));
            ASSERT_LT(glm::distance(glm::dvec2(gradient.z, gradient.w), down), 0.02 * glm::length(down));
            atBorders += faceOf(source, rays.at({x + 1, y})) != index2;
        }
    }
    EXPECT_GT(atBorders, 300u);
}

// What is left of a display when every cell is taken away once: nothing, and no pixel twice.
void expectTiles(const std::vector<LookupCell>& mesh, const PixelRays& rays) {
    const glm::ivec2 sizePx = rays.sizePx();
    std::vector<int> covers(static_cast<size_t>(sizePx.x) * static_cast<size_t>(sizePx.y));
    for (const LookupCell& cell : mesh)
        for (int y = cell.fromPx.y; y < cell.toPx.y; ++y)
            for (int x = cell.fromPx.x; x < cell.toPx.x; ++x)
                ++covers[static_cast<size_t>(y) * static_cast<size_t>(sizePx.x) + static_cast<size_t>(x)];
    size_t index = 0;
    for (int y = 0; y < sizePx.y; ++y)
        for (int x = 0; x < sizePx.x; ++x, ++index) ASSERT_EQ(covers[index], rays.has({x, y}) ? 1 : 0);
}

TEST(LookupMesh, CoversEveryPixelWithARayOnceAndKeepsToItsFace) {
    test::Random random(9);
    for (const int stepPx : {4, 7, 16, 64}) {
        const glm::ivec2 sizePx(150, 110);
        const Wall wall = domeWall(sizePx, random.uniform(100, 340),
                                   glm::dvec3(random.uniform(-180, 180), random.uniform(-90, 90), 0));
        const Projection& projection = *wall.displays[0].projection;
        const PixelRays rays(projection, sizePx);
        const ImageSource source = cubeSource(rays, 128);
        const auto mesh = lookupMesh(source, rays, projection, stepPx);
        expectTiles(mesh, rays);
        const auto exact = sourcePlaces(source, rays), places = meshPlaces(mesh, sizePx);
        for (size_t i = 0; i < exact.size(); ++i) {
            ASSERT_EQ(places[i].w, exact[i].w);
            ASSERT_EQ(places[i].z, exact[i].z);
        }
    }
}

TEST(LookupMesh, IsExactWhereTheLookupIsLinear) {
    // A screen in a source parallel to it.
    const glm::ivec2 sizePx(100, 70);
    const Wall wall = test::planarWall(sizePx, 80);
    const PixelRays rays(*wall.displays[0].projection, sizePx);
    const ImageSource source = cubeSource(rays, 300);
    const auto mesh = lookupMesh(source, rays, *wall.displays[0].projection, 16);
    EXPECT_EQ(mesh.size(), 7u * 5);
    const auto exact = sourcePlaces(source, rays), places = meshPlaces(mesh, sizePx);
    for (size_t i = 0; i < exact.size(); ++i)
        ASSERT_LT(glm::distance(glm::dvec4(places[i]), glm::dvec4(exact[i])), 1e-3);
    EXPECT_LT(lookupError(source, places, wall.displays[0]).maxPx, 1e-3);
}

TEST(LookupMesh, ErrorIsThatOfLinearInterpolation) {
    // On the middle row of a cylinder the place is f tan(phi): between places h apart a chord is off by
    // h^2 / 8 times the second derivative over the first, which is 2 tan(phi), at most tan(phi) h^2 / 4.
    const glm::ivec2 sizePx(640, 2);
    constexpr double kArcRad = 1.5;
    const Wall wall = test::cylinderWall({2, kArcRad, 0.01, {}, {}}, {}, sizePx);
    const PixelRays rays(*wall.displays[0].projection, sizePx);
    const ImageSource source = cubeSource(rays, 4096);
    for (const int stepPx : {8, 16, 32}) {
        const auto mesh = lookupMesh(source, rays, *wall.displays[0].projection, stepPx);
        const double radPerPx = kArcRad / sizePx.x, h = stepPx * radPerPx;
        const double expectedPx = std::tan(kArcRad / 2) * h * h / 4 / radPerPx;
        EXPECT_NEAR(lookupError(source, meshPlaces(mesh, sizePx), wall.displays[0]).maxPx, expectedPx,
                    0.15 * expectedPx);
    }
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
