#pragma once
// What a lens does: the exact map between the pixels of a picture and directions in the lens's own frame
// (x right, y up, ahead is -z). Where it stands and what it throws its picture on is not its business.

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <memory>
#include <optional>
#include <vector>

namespace curvewall {

class Lens {
public:
    virtual ~Lens() = default;

    // Of length one; nothing where the lens shows nothing.
    virtual std::optional<glm::dvec3> direction(glm::dvec2 px) const = 0;

    // Every position that shows the direction, whatever its length, positions outside the picture included.
    virtual std::vector<glm::dvec2> positions(glm::dvec3 direction) const = 0;
};

using LensPtr = std::shared_ptr<const Lens>;

}  // namespace curvewall
