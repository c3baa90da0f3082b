#pragma once
// Calibrations as other programs leave them on disk. Each format has one reader, which answers with the exact
// projection and with what it had to assume.
//
// A reader takes the bytes of a file, a way to find the files that it names, and what the user says of the
// wall; it never opens a file by itself. It throws InputError for a file that cannot be used and FieldError
// for an assumption that was given wrongly.

#include "calibration/files/file_bytes.h"
#include "calibration/formats/decisions.h"
#include "calibration/projections/projection.h"
#include "calibration/wall.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <optional>
#include <string>

namespace curvewall {

// A picture that a mesh or a map bends onto a display, and what is seen in it.
struct SourcePicture {
    glm::dvec2 sizePx{0};
    ProjectionPtr projection;
};

// What is known of a calibration from outside its file.
struct CalibrationRequest {
    std::optional<glm::ivec2> sizePx{};     // of the display
    std::optional<glm::dvec3> eyeM{};       // wall coordinates
    std::optional<SourcePicture> source{};  // for files that say nothing of their source
    std::string display{};                  // the only one wanted; all of them when empty
};

// Whether a format claims the file, by its content and extension.
bool isCalibration(const FileBytes& file);

// The wall that a file describes; one display named after the file where it has no names. The assumptions of
// each display are in it.
Wall readCalibration(const FileBytes& file, const FindFile& find, const CalibrationRequest& request,
                     Decisions& decisions);

// The display's size: the user's, or else what the file says, or else 1920 pixels wide. `aspect` is width
// over height. A user's size of another shape than the file's is worth a warning.
glm::ivec2 decideSize(const CalibrationRequest& request, std::optional<glm::ivec2> fileSizePx,
                      std::optional<double> aspect, Decisions& decisions);

// Moves what was decided into the display.
void listDecisions(const Decisions& decisions, Display& display);

}  // namespace curvewall
