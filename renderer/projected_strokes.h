#pragma once
// Where the points and lines of a scene are on a display, through its true projection. No GL.

#include "calibration/wall.h"
#include "renderer/scene/scene.h"

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <vector>

namespace curvewall {

// The place of a stroke that is nearest, on the display, to a position that it shows at.
struct StrokePlace {
    uint32_t stroke = 0;       // a point of the scene; behind the points come its lines
    double along = 0;          // of a line: 0 at its first end, 1 at the other
    glm::dvec2 alongPerPx{0};  // how fast that grows on the display
    glm::dvec3 fromEyeM{0};    // scene axes
};

// The two vertices of a stroke; a point's are one.
glm::uvec2 verticesOf(const Scene& scene, uint32_t stroke);

const Material& strokeMaterialOf(const Scene& scene, uint32_t stroke);

// A line is the curve that the display makes of it, in chords that are off by at most 0.01 px. Parts that the
// display does not project are left out; where its map folds, each sight of a line is drawn. A display
// that closes on itself shows what lies across its border on both sides.
class ProjectedStrokes {
public:
    ProjectedStrokes(const Scene& scene, const Display& display, const glm::dmat3& sceneFromWall,
                     glm::dvec3 eyeM, int threads);

    // Of every stroke that shows at a position on the display one place, in the order of the strokes.
    std::vector<StrokePlace> at(glm::dvec2 px) const;

private:
    // A straight piece of a stroke on the display; a point has no length.
    struct Chord {
        uint32_t stroke;
        glm::dvec2 fromPx, toPx;
        double fromAlong, toAlong;
        double fromDistanceM, toDistanceM;
    };
    class Projector;

    size_t tileOf(glm::ivec2 tile) const {
        return static_cast<size_t>(tile.y) * static_cast<size_t>(tiles_.x) + static_cast<size_t>(tile.x);
    }
    void fillTiles(const std::vector<Chord>& chords);

    const Scene& scene_;
    glm::dvec3 eyeM_;
    glm::ivec2 sizePx_;
    glm::ivec2 tiles_;
    std::vector<size_t> firstInTile_;  // and one behind the last tile
    std::vector<Chord> inTiles_;       // tile by tile, in the order of the strokes
};

}  // namespace curvewall
