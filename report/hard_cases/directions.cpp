// Triangles that lie where projections tear, meet in a point, or look both ways.

#include "report/hard_cases/case_scenes.h"
#include "report/hard_cases/case_walls.h"
#include "report/hard_cases/families.h"

#include <cmath>
#include <numbers>

namespace curvewall::hard_cases {
namespace {

constexpr double kPi = std::numbers::pi;

// Two halves of a ceiling meet in a line beside the vertical through the eye.
Scene dividedCeiling(double besideM) {
    Scene scene = insideRoom();
    const auto x = static_cast<float>(besideM);
    constexpr float kHalf = 9, kHeight = 2.5f;
    const auto half = [&](size_t paint, float from, float to) {
        startPaint(scene, paint);
        addQuad(scene, {glm::vec3(from, kHeight, -kHalf), glm::vec3(to, kHeight, -kHalf),
                        glm::vec3(to, kHeight, kHalf), glm::vec3(from, kHeight, kHalf)});
    };
    half(0, -kHalf, x);
    half(1, x, kHalf);
    return scene;
}

// Two upright rectangles meet in a vertical line, `angleDeg` beside straight behind.
Scene edgeBehind(double angleDeg) {
    Scene scene = insideRoom();
    const auto at = [](double deg, float y) {
        const double angle = deg * kPi / 180;
        return glm::vec3(4 * std::sin(angle), y, 4 * std::cos(angle));
    };
    startPaint(scene, 0);
    addQuad(scene, {at(-50, -2), at(angleDeg, -2), at(angleDeg, 2), at(-50, 2)});
    startPaint(scene, 1);
    addQuad(scene, {at(angleDeg, -2), at(50, -2), at(50, 2), at(angleDeg, 2)});
    return scene;
}

// Stripes of a floor from 3 m ahead to `behindM` behind.
Scene stripesToBehind(double behindM) {
    Scene scene = insideRoom(40);
    for (size_t i = 0; i < 5; ++i) {
        startPaint(scene, i);
        const float left = -2.5f + static_cast<float>(i), right = left + 0.6f, y = -1,
                    back = static_cast<float>(behindM);
        addQuad(scene, {glm::vec3(left, y, back), glm::vec3(right, y, back), glm::vec3(right, y, -3),
                        glm::vec3(left, y, -3)});
    }
    return scene;
}

// One triangle all around the eye, in a plane close below it.
Scene triangleAround(double belowM) {
    Scene scene = insideRoom();
    const auto y = static_cast<float>(-belowM);
    startPaint(scene, 0);
    addTriangle(scene, {glm::vec3(-5, y, -5), glm::vec3(0, y, 7), glm::vec3(6, y, -3)});
    return scene;
}

// A strip 1 m below and ahead whose edges are seen under an angle.
Scene stripOfAngle(double angleDeg) {
    Scene scene = insideRoom();
    const double nearM = std::sqrt(2), farM = std::sqrt(5), half = std::tan(angleDeg * kPi / 360);
    const auto x = static_cast<float>(nearM * half), xFar = static_cast<float>(farM * half);
    startPaint(scene, 1);
    addQuad(scene,
            {glm::vec3(-x, -1, -1), glm::vec3(x, -1, -1), glm::vec3(xFar, -1, -2), glm::vec3(-xFar, -1, -2)});
    return scene;
}

glm::ivec2 wide(int sizePx, int share) { return {sizePx, sizePx / share}; }

}  // namespace

std::vector<HardCaseFamily> directionFamilies() {
    return {
        {"axis crossing",
         "Triangles overhead hold the axis of a full cylinder, about which their azimuths run full circle; "
         "an edge comes closer and closer to it. Every ceiling of every hall does this.",
         "distance of the edge from the axis, m",
         {1, 0.1, 1e-2, 1e-4, 1e-7, 0},
         0,
         [](double value, int sizePx) {
             return HardCase{fullCylinderWall(wide(sizePx, 2)), shared(dividedCeiling(value))};
         }},
        {"pole crossing",
         "The same ceiling on a panorama, which shows the pole itself: there a whole row of pixels is one "
         "direction.",
         "distance of the edge from the pole's direction, m",
         {1, 0.1, 1e-2, 1e-4, 1e-7, 0},
         1,
         [](double value, int sizePx) {
             return HardCase{panoramaWall(wide(sizePx, 2)), shared(dividedCeiling(value))};
         }},
        {"seam",
         "Surfaces across the two borders of a full turn, which show the same direction, and an edge that "
         "comes to lie along them.",
         "angle between the edge and the seam, deg",
         {30, 1, 1e-2, 1e-4, 1e-6, 0},
         1,
         [](double value, int sizePx) {
             return HardCase{fullCylinderWall(wide(sizePx, 2)), shared(edgeBehind(value))};
         }},
        {"behind the eye",
         "Stripes of a floor that begin ahead and end behind the eye, farther and farther away: what looks "
         "through one perspective picture has to clip them.",
         "distance of the ends behind the eye, m",
         {0.1, 1, 10, 1e3, 1e5, 1e7},
         2,
         [](double value, int sizePx) {
             return HardCase{domeMaster(sizePx), shared(stripesToBehind(value))};
         }},
        {"around the eye",
         "One triangle that surrounds the eye, in a plane closer and closer below it, down to the distance "
         "at which all methods cut (1e-5 of that to the wall, here 2e-5 m).",
         "distance of the plane from the eye, m",
         {1, 0.1, 1e-2, 1e-3, 1e-4, 1e-5},
         1,
         [](double value, int sizePx) {
             return HardCase{fullCylinderWall(wide(sizePx, 2)), shared(triangleAround(value))};
         }},
        {"long edges",
         "A strip of ground whose edges are seen under more and more of half a turn: roads and horizons. The "
         "picture of such an edge is far from straight.",
         "angle that an edge is seen under, deg",
         {60, 120, 170, 179, 179.9, 179.9999},
         2,
         [](double value, int sizePx) {
             return HardCase{fullCylinderWall(wide(sizePx, 2)), shared(stripOfAngle(value))};
         }},
    };
}

}  // namespace curvewall::hard_cases
