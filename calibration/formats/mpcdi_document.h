#pragma once
// The manifest of an MPCDI calibration (VESA, 1.0 and 2.0) as plain values; nothing is decided here. Names
// are read in any letter case, file sets from anywhere below the root, and an element without content is an
// absent one: files of all known writers need that.

#include "calibration/files/file_bytes.h"
#include "calibration/projections/radial_lens.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace curvewall {

struct MpcdiFrustum {
    double yawDeg = 0, pitchDeg = 0, rollDeg = 0;
    double rightDeg = 0, leftDeg = 0, upDeg = 0, downDeg = 0;  // signs as written
};

// The tips of an aircraft's axes: yaw points down, pitch to the right, roll ahead.
struct MpcdiFrame {
    glm::dvec3 position{0}, yaw{0}, pitch{0}, roll{0};
};

struct MpcdiWarp {
    std::string path;
    std::string interpolation, unit, origin;  // empty where absent
};

struct MpcdiPicture {
    std::string path;
    std::optional<double> gamma;
};

// Christie's extension.
struct MpcdiFisheye {
    glm::dvec2 offset{0};                                    // horizontal and vertical
    std::array<double, maths::kRadialTerms> coefficients{};  // f1 first
    double anamorphicRatio = 1;
    double anamorphicDeg = 0;
};

struct MpcdiFiles {
    std::optional<MpcdiWarp> warp, distortion;
    std::optional<MpcdiPicture> alpha, beta;
    std::set<std::string> unread;  // elements that are there and mean something to others
};

struct MpcdiRegion : MpcdiFiles {
    std::string id;
    std::string place;              // in the manifest, for messages
    glm::dvec2 origin{0}, size{1};  // in the buffer, fractions from the top left corner
    std::optional<glm::ivec2> sizePx;
    std::optional<MpcdiFrustum> frustum;
    std::optional<MpcdiFrame> frame;
    std::optional<MpcdiFisheye> fisheye;
};

struct MpcdiBuffer {
    std::string id;
    std::optional<glm::ivec2> sizePx;
    std::vector<MpcdiRegion> regions;
};

struct MpcdiDocument {
    std::string path;     // of the manifest
    std::string profile;  // in lower case: "2d", "3d", "a3d", "sl"
    std::string version;
    std::vector<MpcdiBuffer> buffers;
};

// Throws InputError for what is no manifest, for no region at all, for more than 1024 of them, and for
// numbers that are none.
MpcdiDocument parseMpcdi(const FileBytes& manifest);

// What breaks the standard's rules as a whole, and what one region of the document breaks. Files in use break
// many of them.
std::vector<std::string> brokenRules(const MpcdiDocument& document);
std::vector<std::string> brokenRules(const MpcdiDocument& document, const MpcdiRegion& region);

}  // namespace curvewall
