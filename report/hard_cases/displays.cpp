// Screens at the eye, maps as they are measured, displays of all sizes.

#include "renderer/scene/random.h"
#include "report/hard_cases/case_scenes.h"
#include "report/hard_cases/case_walls.h"
#include "report/hard_cases/families.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace curvewall::hard_cases {
namespace {

const Camera kInRoom{{0.31, 0.22, 0.43}, {0.3, 0.1, 0.05}};

HardCase inRoom(WallPtr wall) { return {std::move(wall), shared(clutteredRoom(1)), kInRoom}; }

glm::ivec2 wide(int sizePx) { return {sizePx, sizePx * 3 / 4}; }

WallPtr flatScreen(int sizePx, glm::dvec3 eyeM) {
    return wallOf({{"type", "planar"},
                   {"lower_left", {-1, -0.75, -1}},
                   {"lower_right", {1, -0.75, -1}},
                   {"upper_left", {-1, 0.75, -1}}},
                  wide(sizePx), eyeM);
}

// Across the middle of the display a step of one pixel along x is one of `step` in the source.
WallPtr foldingScreen(double step, int sizePx) {
    const double swing = (1 - step) * sizePx / (2 * std::numbers::pi);
    return measuredWall(
        {129, 97},
        [&](glm::dvec2 at) {
            return glm::dvec2(swing * std::sin(2 * std::numbers::pi * at.x + at.y),
                              0.02 * sizePx * std::sin(3 * at.y + at.x));
        },
        wide(sizePx));
}

// A node every four pixels.
glm::ivec2 denseNodes(int sizePx) { return wide(sizePx) / 4 + 1; }

WallPtr noisyScreen(double noisePx, int sizePx) {
    Random random(3);
    const auto number = [&] { return noisePx * (random.between(-1, 1) + random.between(-1, 1)); };
    return measuredWall(
        denseNodes(sizePx), [&](glm::dvec2) { return glm::dvec2(number(), number()); }, wide(sizePx));
}

WallPtr screenWithHoles(double share, int sizePx) {
    Random random(4);
    return measuredWall(
        denseNodes(sizePx),
        [&](glm::dvec2 at) {
            if (random.between(0, 1) < share) return glm::dvec2(std::numeric_limits<double>::quiet_NaN());
            return glm::dvec2(5 * std::sin(4 * at.x), 4 * std::sin(5 * at.y));
        },
        wide(sizePx));
}

}  // namespace

std::vector<HardCaseFamily> displayFamilies() {
    return {
        {"eye at a curved wall",
         "The eye walks up to a full cylinder of 2 m until it touches it: a few pixels see half of "
         "everything.",
         "distance of the eye from the wall, m",
         {1, 0.1, 1e-2, 1e-4, 1e-6, 1e-9, 0},
         2,
         [](double value, int sizePx) {
             return inRoom(fullCylinderWall({sizePx, sizePx / 2}, {2 - value, 0, 0}));
         }},
        {"eye at a flat screen",
         "The eye walks up to the middle of a flat screen of 2 m: a field of view of 180 degrees comes from "
         "below.",
         "distance of the eye from the screen, m",
         {1, 0.1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 0},
         1,
         [](double value, int sizePx) {
             return inRoom(flatScreen(sizePx, {0.1, 0.05, value - 1}));
         }},
        {"screen edge on",
         "A flat screen seen from 2 m beside it, more and more along its surface.",
         "distance of the eye from the screen's plane, m",
         {1, 0.1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 0},
         1,
         [](double value, int sizePx) {
             return inRoom(flatScreen(sizePx, {3, 0.1, value - 1}));
         }},
        {"folds of a measured map",
         "A camera texture that is squeezed across its middle until it folds over, as where a projector's "
         "picture bends around a corner: below 0 directions are shown three times.",
         "source pixels per display pixel in the middle",
         {1, 0.5, 0.1, 1e-2, 1e-4, 0, -1e-2, -1},
         7,
         [](double value, int sizePx) { return inRoom(foldingScreen(value, sizePx)); }},
        {"noise in a measured map",
         "A camera texture of a node every four pixels, each off by chance, as a structured light scan "
         "leaves it.",
         "largest noise, px",
         {0, 0.1, 0.5, 2, 8},
         3,
         [](double value, int sizePx) { return inRoom(noisyScreen(value / 2, sizePx)); }},
        {"holes",
         "Nodes of a measured map are missing, singly and everywhere: where nothing was measured nothing is "
         "shown, and what is left stays right.",
         "share of nodes that are missing",
         {0, 1e-3, 1e-2, 0.1, 0.5, 0.9, 1},
         3,
         [](double value, int sizePx) { return inRoom(screenWithHoles(value, sizePx)); }},
        {"huge displays",
         "A full cylinder, wider and wider, up to what OpenGL can hold and beyond; its height is a share of "
         "the size that the suite runs at.",
         "width, px",
         {1024, 4096, 16384, 16385},
         0,
         [](double value, int sizePx) {
             const glm::ivec2 size(static_cast<int>(value), std::max(sizePx / 16, 1));
             return inRoom(
                 wallOf({{"type", "cylinder"}, {"radius", 2}, {"arc_deg", 360}, {"height", 1}}, size));
         }},
        {"tiny displays",
         "A dome master of fewer and fewer pixels, down to a single one.",
         "side, px",
         {64, 16, 4, 2, 1},
         0,
         [](double value, int) { return inRoom(domeMaster(static_cast<int>(value))); }},
    };
}

}  // namespace curvewall::hard_cases
