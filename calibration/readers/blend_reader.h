#pragma once
// The `blend` object of a display: maps and the gamma that they are stored with.

#include "calibration/blending/blend.h"
#include "calibration/files/json_fields.h"
#include "calibration/readers/wall_folder.h"

#include <glm/vec2.hpp>

namespace curvewall {

// Reads the object's keys and the files that they name, relative to `folder`. Throws FieldError, and
// InputError for a file.
BlendMaps readBlend(JsonFields& fields, const WallFolder& folder, glm::ivec2 sizePx);

}  // namespace curvewall
