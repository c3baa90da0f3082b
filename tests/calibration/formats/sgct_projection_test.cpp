// SGCT draws the faces of a cube and looks them up in a shader. Here both are done once more, step by step as
// its sources do them (src/projection/*.cpp, include/sgct/internalshaders.h), and must see what our closed
// forms see.

#include "calibration/formats/sgct_projection.h"

#include "calibration/errors.h"
#include "tests/support/random_numbers.h"

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <glm/trigonometric.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

namespace curvewall {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr glm::ivec2 kSizePx{640, 360};

glm::dmat3 rotated(const glm::dmat3& m, double angleDeg, glm::dvec3 axis) {
    return glm::dmat3(glm::rotate(glm::dmat4(m), glm::radians(angleDeg), axis));
}

// What the cube shows towards a texture coordinate: OpenGL 4.6, table 8.19, and the camera of that face.
glm::dvec3 seenInCube(const glm::dmat3& cube, glm::dvec3 r) {
    const glm::dvec3 a = glm::abs(r);
    glm::dmat3 face(1);
    double sc = 0, tc = 0;
    if (a.x >= a.y && a.x >= a.z) {
        face = rotated(cube, r.x > 0 ? -90 : 90, {0, 1, 0});
        sc = (r.x > 0 ? -r.z : r.z) / a.x;
        tc = -r.y / a.x;
    } else if (a.y >= a.z) {
        face = rotated(cube, r.y > 0 ? -90 : 90, {1, 0, 0});
        sc = r.x / a.y;
        tc = (r.y > 0 ? r.z : -r.z) / a.y;
    } else {
        face = r.z > 0 ? cube : rotated(cube, 180, {0, 1, 0});
        sc = (r.z > 0 ? r.x : -r.x) / a.z;
        tc = -r.y / a.z;
    }
    // The picture's row 0 is its lowest, and t grows upwards in it.
    return glm::normalize(face * glm::dvec3(sc, tc, -1));
}

using Shader = std::function<glm::dvec3(double s, double t)>;  // a texture coordinate of the cube

void expectSame(const Projection& ours, const Shader& shader, const glm::dmat3& cube, uint64_t seed) {
    test::Random random(seed);
    for (int i = 0; i < 1000; ++i) {
        const glm::dvec2 px = random.pixel(kSizePx);
        const auto ray = ours.unproject(px);
        ASSERT_TRUE(ray);
        const glm::dvec3 seen = seenInCube(cube, shader(px.x / kSizePx.x, 1 - px.y / kSizePx.y));
        EXPECT_LT(glm::distance(glm::normalize(*ray), seen), 1e-9) << px.x << ", " << px.y;
    }
}

ProjectionPtr pictureOf(const SgctProjection& projection, const SgctScreen& screen = {kSizePx},
                        const SgctEye& eye = {}, Decisions decisions = Decisions()) {
    return sgctPicture(projection, screen, eye, decisions).projection;
}

const glm::dmat3 kUprightCube = rotated(rotated(glm::dmat3(1), 90, {1, 0, 0}), 45, {0, 0, 1});

TEST(SgctCylinder, IsWhatItsShaderLooksUp) {
    const SgctCylinder cylinder{.rotation = 25, .heightOffset = -0.3};
    const Shader shader = [&](double s, double t) {
        const double angle = -2 * kPi * s + glm::radians(cylinder.rotation);
        return glm::dvec3(std::cos(angle), std::sin(angle), t + cylinder.heightOffset);
    };
    expectSame(*pictureOf(cylinder), shader, kUprightCube, 1);
}

TEST(SgctCylinder, CoversTheHeightsFromTheEyeToOneRadiusAboveIt) {
    const auto projection = pictureOf(SgctCylinder{});
    const glm::dvec3 bottom = *projection->unproject({10, 360}), top = *projection->unproject({10, 0});
    EXPECT_NEAR(bottom.y, 0, 1e-12);
    EXPECT_NEAR(top.y / std::hypot(top.x, top.z), 1, 1e-12);
}

TEST(SgctCylinder, LooksAheadAtTheLeftBorderWhereTheDocumentationIsFollowed) {
    const Decisions documentation(nlohmann::json{{"sgct_convention", "documentation"}});
    const glm::dvec3 ray = *pictureOf(SgctCylinder{}, {kSizePx}, {}, documentation)->unproject({0, 360});
    EXPECT_LT(glm::distance(glm::normalize(ray), glm::dvec3(0, 0, -1)), 1e-12);
}

TEST(SgctEquirectangular, IsWhatItsShaderLooksUp) {
    const Shader shader = [](double s, double t) {
        const double phi = kPi * (1 - t), theta = 2 * kPi * (s - 0.5);
        return glm::dvec3(std::sin(phi) * std::sin(theta), std::sin(phi) * std::cos(theta), std::cos(phi));
    };
    expectSame(*pictureOf(SgctEquirectangular{}), shader, kUprightCube, 2);
}

TEST(SgctEquirectangular, LooksAheadInTheMiddleWhereTheDocumentationIsFollowed) {
    const Decisions documentation(nlohmann::json{{"sgct_convention", "documentation"}});
    const auto projection = pictureOf(SgctEquirectangular{}, {kSizePx}, {}, documentation);
    EXPECT_LT(glm::distance(*projection->unproject({320, 180}), glm::dvec3(0, 0, -1)), 1e-12);
}

struct FisheyeShader {
    double fovDeg = 180;
    glm::dvec3 offset{0};
    bool isFourFaces = true;

    glm::dvec3 operator()(double texelS, double texelT) const {
        const double s = 2 * (texelS - 0.5), t = 2 * (texelT - 0.5);
        const double phi = std::hypot(s, t) * glm::radians(fovDeg) / 2, theta = std::atan2(s, t);
        const glm::dvec3 d =
            glm::dvec3(std::sin(phi) * std::sin(theta), -std::sin(phi) * std::cos(theta), std::cos(phi)) -
            offset;
        constexpr double a = std::numbers::sqrt2 / 2;
        if (isFourFaces) return {a * d.x + a * d.z, d.y, -a * d.x + a * d.z};
        return {a * d.x - a * d.y, a * d.x + a * d.y, d.z};
    }
    glm::dmat3 cube(double tiltDeg) const {
        const glm::dmat3 tilted = rotated(glm::dmat3(1), 90 - tiltDeg, {1, 0, 0});
        return rotated(tilted, 45, isFourFaces ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, 1));
    }
};

// Random points of the picture, laid on the screen as fisheye.cpp's update() lays the textured rectangle.
void expectFisheye(const SgctFisheye& fisheye, const SgctScreen& screen, const FisheyeShader& shader) {
    const double cropAspect = ((1 - 2 * fisheye.cropBottom) + (1 - 2 * fisheye.cropTop)) /
                              ((1 - 2 * fisheye.cropLeft) + (1 - 2 * fisheye.cropRight));
    const double frameAspect =
        screen.pictureAspect.value_or(static_cast<double>(screen.sizePx.x) / screen.sizePx.y);
    double x = 1, y = 1;
    if (fisheye.keepsAspect) {
        const double aspect = frameAspect * cropAspect;
        if (aspect >= 1)
            x = 1 / aspect;
        else
            y = aspect;
    }
    const auto ours = pictureOf(fisheye, screen);
    test::Random random(3);
    int holes = 0;
    for (int i = 0; i < 2000; ++i) {
        const glm::dvec2 ndc(random.uniform(-1, 1), random.uniform(-1, 1));
        const glm::dvec2 px = glm::dvec2(ndc.x + 1, 1 - ndc.y) / 2.0 * glm::dvec2(screen.sizePx);
        const double s = fisheye.cropLeft + (1 - fisheye.cropRight - fisheye.cropLeft) * (ndc.x / x + 1) / 2;
        const double t =
            fisheye.cropBottom + (1 - fisheye.cropTop - fisheye.cropBottom) * (ndc.y / y + 1) / 2;
        const bool isShown =
            std::abs(ndc.x) <= x && std::abs(ndc.y) <= y && std::hypot(2 * s - 1, 2 * t - 1) <= 1;
        const auto ray = ours->unproject(px);
        ASSERT_EQ(ray.has_value(), isShown) << px.x << ", " << px.y;
        holes += !isShown;
        if (!ray) continue;
        const glm::dvec3 seen = seenInCube(shader.cube(fisheye.tiltDeg), shader(s, t));
        EXPECT_LT(glm::distance(glm::normalize(*ray), seen), 1e-9) << px.x << ", " << px.y;
    }
    EXPECT_GT(holes, 100);
    EXPECT_LT(holes, 1900);
}

TEST(SgctFisheyes, LookAtTheZenithOfADomeWithAheadAtTheBottom) {
    const auto projection = pictureOf(SgctFisheye{}, {{400, 400}});
    EXPECT_LT(glm::distance(*projection->unproject({200, 200}), glm::dvec3(0, 1, 0)), 1e-12);
    EXPECT_LT(glm::distance(*projection->unproject({200, 400}), glm::dvec3(0, 0, -1)), 1e-12);
    EXPECT_LT(glm::distance(*projection->unproject({400, 200}), glm::dvec3(1, 0, 0)), 1e-12);
}

TEST(SgctFisheyes, AreWhatTheShaderLooksUpInFourFaces) {
    expectFisheye({.fovDeg = 170, .tiltDeg = 27}, {kSizePx}, {.fovDeg = 170});
}

TEST(SgctFisheyes, AreWhatTheShaderLooksUpInFiveFacesAndMore) {
    expectFisheye({.fovDeg = 240, .tiltDeg = -10}, {{300, 500}}, {.fovDeg = 240, .isFourFaces = false});
}

TEST(SgctFisheyes, AreCroppedAsTheTexturedRectangleIs) {
    expectFisheye({.cropLeft = 0.1, .cropRight = 0.2, .cropBottom = 0.25, .cropTop = 0.05}, {kSizePx}, {});
    expectFisheye({.cropBottom = 0.3, .cropTop = 0.3}, {{300, 500}}, {});
}

TEST(SgctFisheyes, AreStretchedWhereTheyNeedNotKeepTheirShape) {
    expectFisheye({.cropLeft = 0.2, .keepsAspect = false}, {kSizePx}, {});
    expectFisheye({}, {kSizePx, 1.0}, {});  // as the source of a mesh that fills it
}

TEST(SgctFisheyes, MoveTheEyeByTheirOffset) {
    const glm::dvec3 offset(0.2, -0.3, 0.15);
    expectFisheye({.fovDeg = 160, .tiltDeg = 20, .diameterM = 8, .offsetRadii = offset}, {kSizePx},
                  {.fovDeg = 160, .offset = offset});
}

TEST(SgctFisheyes, MoveTheEyeByHalfTheEyesSeparation) {
    // renderCubemap(): offset = separation / diameter, to the right for the right eye.
    const SgctFisheye fisheye{.tiltDeg = 20, .diameterM = 5};
    const auto ours = pictureOf(fisheye, {{400, 400}}, {.eyeM = {0.03, 0, 0}});
    const FisheyeShader shader{.offset = {0.06 / 5, 0, 0}};
    for (const glm::dvec2 px : {glm::dvec2(100, 150), glm::dvec2(210, 330)}) {
        const glm::dvec3 seen = seenInCube(shader.cube(20), shader(px.x / 400, 1 - px.y / 400));
        EXPECT_LT(glm::distance(glm::normalize(*ours->unproject(px)), seen), 1e-9);
    }
}

// projection.cpp: a frustum through the screen's corners in the screen's own axes.
glm::dvec3 seenOnPlane(glm::dvec3 lowerLeft, glm::dvec3 upperLeft, glm::dvec3 upperRight, glm::dvec3 eye,
                       glm::dvec2 fraction) {
    const glm::dvec3 x = glm::normalize(upperRight - upperLeft), y = glm::normalize(upperLeft - lowerLeft);
    const glm::dmat3 world(x, y, glm::normalize(glm::cross(x, y)));
    const glm::dmat3 view = glm::inverse(world);
    const glm::dvec3 low = view * lowerLeft - view * eye, high = view * upperRight - view * eye;
    const double nearFactor = std::abs(1 / low.z);
    return glm::normalize(world * glm::dvec3(glm::mix(low.x, high.x, fraction.x) * nearFactor,
                                             glm::mix(low.y, high.y, fraction.y) * nearFactor, -1));
}

TEST(SgctPlanes, AreFrustaThroughTheirCorners) {
    const SgctPlane plane{{-1.5, -0.9, -1}, {-1.4, 1.1, -1.3}, {1.2, 1.2, -0.2}};
    const glm::dvec3 eye(0.1, 0.2, 1.5);
    const auto ours = pictureOf(plane, {kSizePx}, {eye, eye});
    for (const glm::dvec2 at : {glm::dvec2(0.2, 0.7), glm::dvec2(1, 0), glm::dvec2(0.5, 0.5)}) {
        const glm::dvec3 seen = seenOnPlane(plane.lowerLeftM, plane.upperLeftM, plane.upperRightM, eye, at);
        const auto ray = ours->unproject(glm::dvec2(at.x, 1 - at.y) * glm::dvec2(kSizePx));
        EXPECT_LT(glm::distance(glm::normalize(*ray), seen), 1e-9);
    }
}

TEST(SgctPlanar, StandsAtItsDistanceFromTheOriginTurnedAndThenShifted) {
    const glm::dquat rotation = glm::normalize(glm::dquat(0.8, 0.1, -0.4, 0.2));
    const SgctPlanar planar{-40, 50, -20, 30, 3.0, glm::mat3_cast(rotation), {0.3, 0.1, -0.2}, false};
    const auto corner = [&](double horizontalDeg, double verticalDeg) {
        const double x = 3 * std::tan(glm::radians(horizontalDeg)),
                     y = 3 * std::tan(glm::radians(verticalDeg));
        return rotation * glm::dvec3(x, y, -3) + planar.offsetM;
    };
    const glm::dvec3 eye(0.5, -0.2, 0.4);
    const auto ours = pictureOf(planar, {kSizePx}, {eye, eye});
    for (const glm::dvec2 at : {glm::dvec2(0.2, 0.7), glm::dvec2(0, 1), glm::dvec2(0.5, 0.5)}) {
        const glm::dvec3 seen = seenOnPlane(corner(-40, -20), corner(-40, 30), corner(50, 30), eye, at);
        const auto ray = ours->unproject(glm::dvec2(at.x, 1 - at.y) * glm::dvec2(kSizePx));
        EXPECT_LT(glm::distance(glm::normalize(*ray), seen), 1e-9);
    }
}

TEST(SgctPlanar, AsksForItsDistanceOnlyWhereTheEyeIsElsewhere) {
    const SgctPlanar planar{-40, 40, -20, 20};
    Decisions nothing;
    sgctPicture(planar, {kSizePx}, {}, nothing);
    EXPECT_THAT(nothing.taken(), testing::IsEmpty());
    Decisions something;
    sgctPicture(planar, {kSizePx}, {{0, 0, 4}, {0, 0, 4}}, something);
    ASSERT_EQ(something.taken().size(), 1U);
    EXPECT_EQ(something.taken()[0].key, "distance_m");
}

TEST(SgctPlanar, RefusesAnglesWithoutAnArea) {
    EXPECT_THROW(pictureOf(SgctPlanar{30, -30, -20, 20}), UsageError);
}

// A face of sphericalmirror.cpp or cubemap.cpp: a square at the distance one, turned.
void expectFace(const SgctFace& face, const glm::dmat3& turned) {
    for (const glm::dvec2 at : {glm::dvec2(0, 0), glm::dvec2(1, 0), glm::dvec2(0.25, 0.75)}) {
        const glm::dvec3 seen = turned * glm::normalize(glm::dvec3(2 * at.x - 1, 2 * at.y - 1, -1));
        const auto ray = face.projection->unproject(glm::dvec2(at.x, 1 - at.y) * 100.0);
        EXPECT_LT(glm::distance(glm::normalize(*ray), seen), 1e-9) << face.name;
    }
}

TEST(SgctMirrors, HaveAFaceAheadForTheBottomMeshAndThreeBesideAndAboveIt) {
    const auto faces = sgctMirrorFaces({.tiltDeg = 12}, {100, 100});
    const glm::dmat3 tilted = rotated(glm::dmat3(1), 45 - 12, {1, 0, 0});
    ASSERT_EQ(faces.size(), 4U);
    expectFace(faces[0], tilted);
    expectFace(faces[1], rotated(tilted, 90, {0, 1, 0}));
    expectFace(faces[2], rotated(tilted, -90, {0, 1, 0}));
    expectFace(faces[3], rotated(tilted, 90, {1, 0, 0}));
}

TEST(SgctCubes, HaveSixFacesThatAreTurnedAsTheProgramTurnsThem) {
    Decisions decisions;
    const auto faces = sgctCubeFaces({.facePx = 100, .yawDeg = 20, .pitchDeg = 35, .rollDeg = 5}, decisions);
    // cubemap.cpp: about y by what the file calls pitch.
    const glm::dmat3 rig =
        rotated(rotated(rotated(glm::dmat3(1), -35, {0, 1, 0}), 20, {1, 0, 0}), -5, {0, 0, 1});
    ASSERT_EQ(faces.size(), 6U);
    expectFace(faces[0], rotated(rig, -90, {0, 1, 0}));
    expectFace(faces[1], rotated(rig, 90, {0, 1, 0}));
    expectFace(faces[2], rotated(rig, -90, {1, 0, 0}));
    expectFace(faces[3], rotated(rig, 90, {1, 0, 0}));
    expectFace(faces[4], rig);
    expectFace(faces[5], rotated(rig, 180, {0, 1, 0}));
}

TEST(SgctCubes, LeaveOutFacesThatAreSwitchedOff) {
    Decisions decisions;
    const auto faces = sgctCubeFaces({.right = false, .bottom = false}, decisions);
    ASSERT_EQ(faces.size(), 4U);
    EXPECT_EQ(faces[0].name, "left");
    EXPECT_EQ(faces[1].name, "top");
    EXPECT_THAT(decisions.taken(), testing::IsEmpty());
}

TEST(SgctViews, TellUnderWhichAnglesTheEyeSeesAScreen) {
    const SgctPlanar planar{-40, 50, -20, 30, 2.0, glm::mat3_cast(glm::angleAxis(0.3, glm::dvec3(0, 1, 0)))};
    const SgctView view = *sgctView(planar, glm::dvec3(0));
    EXPECT_NEAR(view.leftDeg, -40, 1e-9);
    EXPECT_NEAR(view.rightDeg, 50, 1e-9);
    EXPECT_NEAR(view.downDeg, -20, 1e-9);
    EXPECT_NEAR(view.upDeg, 30, 1e-9);
    for (int column = 0; column < 3; ++column)
        EXPECT_LT(glm::distance(view.rotation[column], planar.rotation[column]), 1e-9);
    EXPECT_FALSE(sgctView(SgctFisheye{}, glm::dvec3(0)));
}

}  // namespace
}  // namespace curvewall
