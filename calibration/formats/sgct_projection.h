#pragma once
// What a viewport of SGCT shows, exactly. docs/formats/sgct.md derives each formula from SGCT's sources.

#include "calibration/formats/sgct_document.h"
#include "calibration/projections/frustum.h"
#include "calibration/projections/projection.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <optional>
#include <string>
#include <vector>

namespace curvewall {

struct SgctScreen {
    glm::ivec2 sizePx{0};
    // Width over height that the picture is made for, where a mesh stretches it over the screen.
    std::optional<double> pictureAspect{};
};

// Where the eye is and where the configuration's user is; what SGCT draws at infinity is centred on him.
struct SgctEye {
    glm::dvec3 eyeM{0};
    glm::dvec3 userM{0};
};

struct SgctPicture {
    ProjectionPtr projection;
    std::string type;  // as wall files name it
};

// The picture of one viewport, without a correction mesh; not for SgctMirror, SgctCube and
// SgctUnknownProjection. Asks only what the configuration leaves open. Throws UsageError for a screen that
// the eye cannot see.
SgctPicture sgctPicture(const SgctProjection& projection, const SgctScreen& screen, const SgctEye& eye,
                        Decisions& decisions);

struct SgctFace {
    std::string name;
    ProjectionPtr projection;
};

// The faces that a spherical mirror's meshes take from, in the order bottom, left, right, top.
std::vector<SgctFace> sgctMirrorFaces(const SgctMirror& mirror, glm::dvec2 facePx);

// The faces of a cube that are shown.
std::vector<SgctFace> sgctCubeFaces(const SgctCube& cube, Decisions& decisions);

// The four angles and the orientation under which the eye sees a planar screen; nothing for other
// projections.
struct SgctView {
    double leftDeg, rightDeg, downDeg, upDeg;
    glm::dmat3 rotation;  // world from view
};
std::optional<SgctView> sgctView(const SgctProjection& projection, glm::dvec3 eyeM);

}  // namespace curvewall
