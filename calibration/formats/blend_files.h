#pragma once
// Pictures that tell what a display does to its light, as calibration files name them: blend masks, alpha and
// black level maps.

#include "calibration/files/file_bytes.h"
#include "calibration/files/map_file.h"
#include "calibration/formats/decisions.h"
#include "calibration/formats/texel_budget.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <vector>

namespace curvewall {

// One value a channel and pixel of the display, row by row from the top, in linear light: what is stored, ^
// gamma. A grey picture has three equal channels. One of another size than the display's is resampled
// bilinearly, and one with an alpha channel that says something loses it; both with a warning that begins
// with `place`. Throws InputError for what is no picture of numbers from 0 to 1. The display's own size is
// the caller's to take from the budget; a picture of another size takes that one.
std::vector<glm::vec3> readBlendPicture(const FileBytes& file, glm::ivec2 sizePx, double gamma,
                                        const std::string& place, Decisions& decisions,
                                        TexelBudget* budget = nullptr);

// The same for a picture that is in memory; `path` is for messages.
std::vector<glm::vec3> linearPicture(const NumberMap& map, const std::string& path, glm::ivec2 sizePx,
                                     double gamma, const std::string& place, Decisions& decisions);

}  // namespace curvewall
