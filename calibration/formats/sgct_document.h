#pragma once
// What a configuration of SGCT says, version 1 JSON and the older XML alike: nodes (computers) with windows
// with viewports, and users (eyes). Nothing is computed from it here.
//
// Axes are ours: x right, y up, -z ahead. Viewports are placed from the bottom left corner of their window.

#include "calibration/files/file_bytes.h"
#include "calibration/formats/decisions.h"

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace curvewall {

// PlanarProjection and TextureMappedProjection: a screen `distanceM` ahead of the origin, turned about it and
// then shifted.
struct SgctPlanar {
    double leftDeg = 0, rightDeg = 0, downDeg = 0, upDeg = 0;  // left and down are negative inside
    std::optional<double> distanceM{};
    glm::dmat3 rotation{1};
    glm::dvec3 offsetM{0};
    bool isTextureMapped = false;
};

// ProjectionPlane; the default is SGCT's for a viewport without a projection.
struct SgctPlane {
    glm::dvec3 lowerLeftM{-1, -1, -2}, upperLeftM{-1, 1, -2}, upperRightM{1, 1, -2};
};

struct SgctFisheye {
    double fovDeg = 180;
    double tiltDeg = 0;
    double diameterM = 14.8;
    double cropLeft = 0, cropRight = 0, cropBottom = 0, cropTop = 0;  // fractions of the picture
    glm::dvec3 offsetRadii{0};
    bool keepsAspect = true;
    std::optional<glm::dvec3> background{};  // encoded
};

struct SgctCylinder {
    double rotation = 0;  // see SgctConvention
    double heightOffset = 0;
    double radiusM = 5;
};

struct SgctEquirectangular {};

struct SgctMirror {
    double tiltDeg = 0;
    std::string bottomMesh{}, leftMesh{}, rightMesh{}, topMesh{};
};

// CubemapProjection, once SpoutOutputProjection: six pictures on the network.
struct SgctCube {
    int facePx = 512;
    // In SGCT's order.
    bool right = true, left = true, bottom = true, top = true, front = true, back = true;
    double yawDeg = 0, pitchDeg = 0, rollDeg = 0;
};

struct SgctUnknownProjection {
    std::string type;
};

using SgctProjection = std::variant<SgctPlane, SgctPlanar, SgctFisheye, SgctCylinder, SgctEquirectangular,
                                    SgctMirror, SgctCube, SgctUnknownProjection>;

struct SgctViewport {
    std::string place;  // for messages: "nodes[0].windows[1].viewports[0]"
    std::string name;   // of old XML; may be empty
    glm::dvec2 position{0}, size{1};
    SgctProjection projection{};
    bool hasProjection = false;
    std::string mesh{}, blendMask{}, blackLevelMask{}, overlay{}, user{};  // empty: none
    std::string eye{};                                                     // "", "center", "left" or "right"
};

struct SgctWindow {
    std::string place;
    std::string name;
    std::optional<glm::ivec2> sizePx{};  // of the framebuffer
    std::optional<double> aspect{};      // of the window itself, width over height
    std::string stereo = "none";
    bool isMirroredX = false, isMirroredY = false;
    bool drawsScene = true;
    std::optional<int> copyOf{};          // the number of another window
    std::string mpcdi{}, scalableMesh{};  // files that stand for the viewports
    std::vector<SgctViewport> viewports{};
};

struct SgctNode {
    std::string address;
    std::vector<SgctWindow> windows{};
};

struct SgctUser {
    std::string name;  // empty: the one of every viewport that names none
    glm::dvec3 positionM{0};
    double eyeSeparationM = 0.06;
};

struct SgctDocument {
    bool isXml = false;
    std::vector<SgctNode> nodes{};
    std::vector<SgctUser> users{};
};

// By its content: JSON with nodes, or XML with a <Cluster>.
bool isSgctDocument(const FileBytes& file);

// Keys that nobody knows are passed over; one warning lists those near a projection. Throws InputError.
SgctDocument readSgctDocument(const FileBytes& file, Decisions& decisions);

}  // namespace curvewall
