#pragma once
// The `blend` object of a display: maps and the gamma that they are stored with.

#include "calibration/blending/blend.h"
#include "calibration/files/json_fields.h"

#include <glm/vec2.hpp>

#include <filesystem>

namespace curvewall {

// Reads the object's keys and the files that they name, relative to `folder`. Throws FieldError, and
// InputError for a file.
BlendMaps readBlend(JsonFields& fields, const std::filesystem::path& folder, glm::ivec2 sizePx);

}  // namespace curvewall
