#pragma once
// Lenses as wall files write them. Each function reads the keys of one type and leaves others to the caller.

#include "calibration/files/json_fields.h"
#include "calibration/projections/lens.h"

#include <glm/vec2.hpp>

namespace curvewall {

// Throw FieldError.
LensPtr readRadialLens(JsonFields& fields, glm::ivec2 sizePx);
LensPtr readEquirectangularLens(JsonFields& fields, glm::ivec2 sizePx);
LensPtr readSphereSlicesLens(JsonFields& fields, glm::ivec2 sizePx);
LensPtr readCurvilinearLens(JsonFields& fields, glm::ivec2 sizePx);
LensPtr readCameraLens(JsonFields& fields, glm::ivec2 sizePx);

}  // namespace curvewall
