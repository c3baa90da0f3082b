#pragma once
// Projections as wall files write them, by the `type` of their object.

#include "calibration/files/json_fields.h"
#include "calibration/projections/projection.h"
#include "calibration/readers/wall_folder.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace curvewall {

// What a projection has from outside its own object.
struct ProjectionContext {
    WallFolder folder;
    glm::dvec3 eyeM{0};    // wall coordinates
    glm::ivec2 sizePx{0};  // of the display
};

// What a file says of a display beside its blend. Most types have a projection and nothing else.
struct ReadProjection {
    ReadProjection() = default;
    template <class Type>
    ReadProjection(std::shared_ptr<Type> read, std::vector<float> factors = {})
        : projection(std::move(read)), intensity(std::move(factors)) {}

    ProjectionPtr projection;
    std::vector<float> intensity;  // multiplies the picture, a factor a pixel in linear light; empty: one
};

// Reads the keys of `type` and leaves unknown ones to the caller. Throws FieldError, InputError for a file
// that the object names, and UsageError for a display that the eye cannot see.
ReadProjection readProjection(JsonFields& fields, const std::string& type, const ProjectionContext& context);

}  // namespace curvewall
