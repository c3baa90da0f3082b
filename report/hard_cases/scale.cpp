// Scenes far from their origin, huge and tiny ones.

#include "report/hard_cases/case_scenes.h"
#include "report/hard_cases/case_walls.h"
#include "report/hard_cases/families.h"

namespace curvewall::hard_cases {
namespace {

constexpr glm::dvec3 kEyeM(0.31, 0.22, 0.43);

HardCase atScale(double scale, int sizePx) {
    return {domeMaster(sizePx), shared(clutteredRoom(scale)), {scale * kEyeM, {}}};
}

// A panel of squares of a tenth of a millimetre, 5 mm ahead of an eye that is far along x.
HardCase finePanel(double alongM, int sizePx) {
    constexpr int kSquares = 20;
    constexpr double kSideM = 1e-4, kAheadM = 5e-3;
    Scene scene = boxRoom(glm::vec3(20));
    for (glm::vec3& position : scene.positions) position.x += static_cast<float>(alongM);
    for (size_t paint = 0; paint < 2; ++paint) {
        startPaint(scene, paint);
        for (int y = 0; y < kSquares; ++y)
            for (int x = 0; x < kSquares; ++x) {
                if ((static_cast<size_t>(x + y) & 1) != paint) continue;
                const auto at = [&](int i, int k) {
                    return glm::vec3(alongM + (i - 0.5 * kSquares) * kSideM, (k - 0.5 * kSquares) * kSideM,
                                     -kAheadM);
                };
                addQuad(scene, {at(x, y), at(x + 1, y), at(x + 1, y + 1), at(x, y + 1)});
            }
    }
    return {domeMaster(sizePx), shared(std::move(scene)), {{alongM, 0, 0}, {}}};
}

}  // namespace

std::vector<HardCaseFamily> scaleFamilies() {
    return {
        {"far from the origin",
         "A room with things in it, moved away by its root node together with the eye. Surveyed sites come "
         "in coordinates of a country or of the earth. Single precision has lost a metre at 1e7 m.",
         "distance of the root node from the origin, m",
         {0, 1e3, 1e5, 1e7, 1e9, 1e12},
         3,
         [](double value, int sizePx) {
             HardCase made = atScale(1, sizePx);
             Scene scene = *made.scene;
             const glm::dvec3 movedM = value * glm::dvec3(0.7, 0.1, -0.7);
             scene.originM += movedM;
             made.scene = shared(std::move(scene));
             made.camera.positionM += movedM;
             return made;
         }},
        {"huge scenes",
         "The same room and eye, enlarged: from a room to the solar system, and on to where squares of "
         "lengths leave single precision.",
         "scale",
         {1, 1e2, 1e4, 1e7, 1e9, 1e11, 1e13, 1e30},
         3,
         atScale},
        {"tiny scenes",
         "The same room and eye, made smaller, until all of it is nearer than what every method cuts (1e-5 m "
         "for a lens).",
         "scale",
         {1, 0.1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6},
         3,
         atScale},
        {"fine details far along an axis",
         "Squares of 0.1 mm, 5 mm ahead of the eye, whose vertices themselves are far along an axis: their "
         "single precision moves them, and what is drawn should be what is left of them.",
         "distance along the axis, m",
         {0, 1, 10, 100, 1e3},
         2,
         finePanel},
    };
}

}  // namespace curvewall::hard_cases
