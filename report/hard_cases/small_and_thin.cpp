// Triangles smaller or thinner than a pixel, and surfaces in one plane.

#include "report/hard_cases/case_scenes.h"
#include "report/hard_cases/case_walls.h"
#include "report/hard_cases/families.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace curvewall::hard_cases {
namespace {

constexpr float kAheadM = -2;

// A wall of 4 x 4 m whose middle is made of slivers 4 m high. It is of one colour, so that only gaps show.
Scene sliverWall(double aspect) {
    Scene scene = insideRoom();
    startPaint(scene, 0);
    const int count = static_cast<int>(std::min(64.0, aspect / 2));
    const double width = 4 / aspect;
    const auto column = [&](double x, float y) { return glm::vec3(x, y, kAheadM); };
    const auto strip = [&](double from, double to) {
        addQuad(scene, {column(from, -2), column(to, -2), column(to, 2), column(from, 2)});
    };
    const double first = -0.5 * width * count;
    strip(-2, first);
    for (int i = 0; i < count; ++i) strip(first + width * i, first + width * (i + 1));
    strip(first + width * count, 2);
    return scene;
}

// A square of one colour, cut into triangles whose legs are seen under `sidePx` pixels.
Scene finePatch(double sidePx, int sizePx) {
    Scene scene = insideRoom();
    startPaint(scene, 0);
    const int cells = static_cast<int>(std::clamp(sizePx / (2 * sidePx), 2.0, 100.0));
    const double side = -kAheadM * sidePx * std::numbers::pi / sizePx;
    const auto at = [&](int x, int y) {
        return glm::vec3((x - 0.5 * cells) * side, (y - 0.5 * cells) * side, kAheadM);
    };
    for (int y = 0; y < cells; ++y)
        for (int x = 0; x < cells; ++x)
            addQuad(scene, {at(x, y), at(x + 1, y), at(x + 1, y + 1), at(x, y + 1)});
    return scene;
}

// A disc of one colour about a corner that all its triangles share.
Scene fan(double triangles) {
    Scene scene = insideRoom();
    startPaint(scene, 0);
    const auto count = static_cast<int>(triangles);
    const auto at = [&](int i) {
        const double angle = 2 * std::numbers::pi * (i % count) / count;
        return glm::vec3(2 * std::cos(angle), 2 * std::sin(angle), kAheadM);
    };
    for (int i = 0; i < count; ++i) addTriangle(scene, {glm::vec3(0.05f, 0.03f, kAheadM), at(i), at(i + 1)});
    return scene;
}

// A band all around the eye of upright slivers.
Scene band(double slivers) {
    Scene scene = insideRoom();
    startPaint(scene, 1);
    const auto count = static_cast<int>(slivers);
    const auto at = [&](int i, float y) {
        const double angle = 2 * std::numbers::pi * (i % count) / count;
        return glm::vec3(3 * std::sin(angle), y, 3 * std::cos(angle));
    };
    for (int i = 0; i < count; ++i) addQuad(scene, {at(i, -1), at(i + 1, -1), at(i + 1, 1), at(i, 1)});
    return scene;
}

// A poster on a wall that is cut otherwise.
Scene poster(double gap) {
    Scene scene = insideRoom();
    startPaint(scene, 0);
    addFrontalSquare(scene, {0, 0, -3}, 5);
    startPaint(scene, 1);
    const auto z = static_cast<float>(-3 * (1 - gap));
    addQuad(scene, {glm::vec3(-1.1f, -0.8f, z), glm::vec3(0.9f, -1, z), glm::vec3(1.2f, 0.9f, z),
                    glm::vec3(-0.8f, 1.1f, z)});
    return scene;
}

}  // namespace

std::vector<HardCaseFamily> smallAndThinFamilies() {
    return {
        {"slivers",
         "A wall in whose middle are up to 64 slivers, thinner and thinner, of its own colour: wherever two "
         "of them do not meet, the room behind shines through. Cutters and CAD exports make such triangles.",
         "aspect, length over width",
         {10, 100, 1e3, 1e4, 1e5, 1e6},
         1,
         [](double value, int sizePx) {
             return HardCase{domeMaster(sizePx), shared(sliverWall(value))};
         }},
        {"sub-pixel triangles",
         "A patch of up to 20,000 triangles that shrink far below a pixel; gaps would show the room behind. "
         "Scanned and sculpted models look like this from any distance.",
         "side of a triangle, px",
         {8, 2, 1, 0.5, 0.2, 0.1, 0.05},
         2,
         [](double value, int sizePx) {
             return HardCase{domeMaster(sizePx), shared(finePatch(value, sizePx))};
         }},
        {"fan",
         "A disc of thin triangles that all meet in one corner ahead: in the middle hundreds of them share a "
         "pixel. Modellers cap cylinders like this.",
         "triangles",
         {10, 100, 1e3, 1e4},
         1,
         [](double value, int sizePx) {
             return HardCase{domeMaster(sizePx), shared(fan(value))};
         }},
        {"band of slivers",
         "A closed band of upright slivers around the eye, seen on a full cylinder, seam and all.",
         "slivers",
         {10, 100, 1e3, 1e4, 1e5},
         1,
         [](double value, int sizePx) {
             return HardCase{fullCylinderWall({sizePx, sizePx / 2}), shared(band(value))};
         }},
        {"coplanar overlaps",
         "A poster closer and closer before a wall, until both are in one plane, where no order is right and "
         "which of the two is seen is for each method to say. Decals and road markings are modelled like "
         "this.",
         "gap, in distances from the eye",
         {0.1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 0},
         3,
         [](double value, int sizePx) {
             return HardCase{domeMaster(sizePx), shared(poster(value))};
         }},
    };
}

}  // namespace curvewall::hard_cases
