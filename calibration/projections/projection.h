#pragma once
// The exact map between the pixels of a display and the rays of the eye.
//
// Frames: rays are in wall axes (right-handed, y up, metres) with the eye at the origin. Pixels are
// continuous: (0, 0) is the top left corner of the display, the first pixel's centre is (0.5, 0.5), x grows
// to the right and y down. Everything is in double precision; no projection knows of OpenGL.

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <memory>
#include <optional>
#include <vector>

namespace curvewall {

class Projection {
public:
    virtual ~Projection() = default;

    // The ray that the screen position `px` sees. Where the display is a real surface the vector ends on it
    // (its length is the distance from the eye in metres); elsewhere it has length one. Nothing where the
    // display shows nothing. Positions outside the display answer as far as the formula holds.
    virtual std::optional<glm::dvec3> unproject(glm::dvec2 px) const = 0;

    // Every screen position that sees the ray, whatever the ray's length: none, one, or several where the
    // map folds. Positions outside the display's rectangle, or in a hole of it where the formula goes on (the
    // corners around a fisheye's circle), are answers too; the display does not show them.
    // On a full turn x lies in [0, width).
    virtual std::vector<glm::dvec2> project(glm::dvec3 ray) const = 0;

    // Whether it is another from another eye. One that only knows directions is the same from everywhere.
    virtual bool dependsOnEye() const { return true; }

    // The same display seen from another eye (metres, wall coordinates); what is large is shared. Throws
    // UsageError where the eye cannot see it.
    virtual std::shared_ptr<const Projection> seenFrom(glm::dvec3 eyeM) const = 0;
};

using ProjectionPtr = std::shared_ptr<const Projection>;

}  // namespace curvewall
