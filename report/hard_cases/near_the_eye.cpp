// What touches the eye, or nearly.

#include "report/hard_cases/case_scenes.h"
#include "report/hard_cases/case_walls.h"
#include "report/hard_cases/families.h"

namespace curvewall::hard_cases {
namespace {

Scene squareAhead(double distanceM) {
    Scene scene = insideRoom();
    const auto d = static_cast<float>(distanceM);
    startPaint(scene, 0);
    addFrontalSquare(scene, {0, 0, -d}, 4 * d);
    return scene;
}

// The sides of a pyramid whose tip points at the eye, without its base.
Scene pyramid(double distanceM) {
    Scene scene = insideRoom();
    const glm::vec3 tip(0, 0, -distanceM);
    const std::array<glm::vec3, 4> base{glm::vec3(-1.2f, -1, -3), glm::vec3(1, -1.1f, -3),
                                        glm::vec3(1.1f, 1, -3), glm::vec3(-1, 0.9f, -3)};
    for (size_t i = 0; i < 4; ++i) {
        startPaint(scene, i);
        addTriangle(scene, {tip, base[i], base[(i + 1) % 4]});
    }
    return scene;
}

// Two slopes whose ridge runs past below the eye.
Scene ridge(double distanceM) {
    Scene scene = insideRoom();
    const auto y = static_cast<float>(-distanceM);
    startPaint(scene, 0);
    addQuad(scene, {glm::vec3(-5, y, 0), glm::vec3(5, y, 0), glm::vec3(5, -2, -3), glm::vec3(-5, -2, -3)});
    startPaint(scene, 1);
    addQuad(scene, {glm::vec3(-5, y, 0), glm::vec3(5, y, 0), glm::vec3(5, -2, 3), glm::vec3(-5, -2, 3)});
    return scene;
}

// Slabs of a floor, the first of them 1 m ahead.
Scene floorBelow(double distanceM) {
    Scene scene = insideRoom(60);
    const auto y = static_cast<float>(-distanceM);
    for (size_t i = 0; i < 5; ++i) {
        startPaint(scene, i);
        const float nearM = 1 + 4 * static_cast<float>(i), farM = nearM + 4;
        addQuad(scene, {glm::vec3(-8, y, -nearM), glm::vec3(8, y, -nearM), glm::vec3(8, y, -farM),
                        glm::vec3(-8, y, -farM)});
    }
    return scene;
}

}  // namespace

std::vector<HardCaseFamily> nearTheEyeFamilies() {
    return {
        {"near plane",
         "A square comes up to the eye and goes through the distance at which all methods cut: 1e-5 of that "
         "to the wall, which is 1e-5 m for a lens. A tracked visitor leans over a rail.",
         "distance of the square, m",
         {1, 0.1, 1e-2, 1e-3, 1e-4, 3e-5, 1e-5, 1e-6},
         2,
         [](double value, int sizePx) {
             return HardCase{domeMaster(sizePx), shared(squareAhead(value))};
         }},
        {"vertex at the eye",
         "The tip of a pyramid comes up to the eye, until its sides are seen edge on and show nothing.",
         "distance of the tip, m",
         {1, 0.1, 1e-2, 1e-4, 1e-6, 1e-8, 0},
         2,
         [](double value, int sizePx) {
             return HardCase{domeMaster(sizePx), shared(pyramid(value))};
         }},
        {"edge through the eye",
         "A ridge passes closer and closer below the eye, until it goes through it.",
         "distance of the edge, m",
         {1, 0.1, 1e-2, 1e-4, 1e-6, 1e-8, 0},
         2,
         [](double value, int sizePx) {
             return HardCase{domeMaster(sizePx), shared(ridge(value))};
         }},
        {"surfaces edge on",
         "A floor ahead of the eye sinks to a line: its slabs keep their lengths and lose their heights. "
         "Every table top at eye height is one.",
         "distance of the floor's plane from the eye, m",
         {1, 0.1, 1e-2, 1e-3, 1e-5, 1e-7, 0},
         1,
         [](double value, int sizePx) {
             return HardCase{domeMaster(sizePx), shared(floorBelow(value))};
         }},
    };
}

}  // namespace curvewall::hard_cases
