#pragma once
// Displays behind round lenses: all models, narrower than half a turn and wider, turned away from -z.

#include "calibration/projections/lens_projection.h"
#include "calibration/projections/radial_lens.h"
#include "calibration/wall.h"
#include "tests/support/test_walls.h"

#include <memory>
#include <string>
#include <vector>

namespace curvewall::test {

struct LensKind {
    std::string name;
    RadialFunction function;
    double fovDeg = 180;
    bool isCurvilinear = false;
};

inline void PrintTo(const LensKind& kind, std::ostream* out) { *out << kind.name; }

inline RadialFunction polynomialLens() { return {RadialModel::polynomial, {1, 0, -0.08, 0, 0.004}}; }

// Orthographic lenses end at 180 degrees, and stereographic ones below 360.
inline std::vector<LensKind> lensKinds() {
    const RadialFunction orthographic{RadialModel::orthographic}, stereographic{RadialModel::stereographic},
        equisolid{RadialModel::equisolid}, equidistant{RadialModel::equidistant};
    return {{"Orthographic180", orthographic, 180},
            {"Orthographic110", orthographic, 110},
            {"Stereographic180", stereographic, 180},
            {"Stereographic80", stereographic, 80},
            {"Stereographic270", stereographic, 270},
            {"Stereographic340", stereographic, 340},
            {"Equisolid180", equisolid, 180},
            {"Equisolid140", equisolid, 140},
            {"Equisolid270", equisolid, 270},
            {"Equisolid360", equisolid, 360},
            {"Equidistant180", equidistant, 180},
            {"Equidistant60", equidistant, 60},
            {"Equidistant270", equidistant, 270},
            {"Equidistant360", equidistant, 360},
            {"Polynomial180", polynomialLens(), 180},
            {"Polynomial120", polynomialLens(), 120},
            {"Polynomial340", polynomialLens(), 340},
            {"Curvilinear80", stereographic, 80, true},
            {"Curvilinear130", stereographic, 130, true}};
}

inline Wall lensWall(const LensKind& kind, glm::ivec2 sizePx, const Orientation& orientation = {}) {
    const double fovRad = kind.fovDeg * kPi / 180;
    const LensPtr lens =
        kind.isCurvilinear ? curvilinearLens(fovRad, sizePx) : circularLens(kind.function, fovRad, sizePx);
    return {kind.name,
            {},
            {},
            {{"front", sizePx, kind.isCurvilinear ? "curvilinear" : "radial",
              std::make_shared<LensProjection>(lens, orientation)}}};
}

inline constexpr Orientation kTurned{0.5, 0.4, -0.2};

}  // namespace curvewall::test
