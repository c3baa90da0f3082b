#pragma once
// A wall in the files of other programs, and what that costs.

#include "calibration/wall.h"
#include "calibration/writers/conversion_error.h"

#include <glm/vec2.hpp>

#include <optional>
#include <string>
#include <vector>

namespace curvewall {

enum class ConvertedKind { cameraTexture, surfaceMap, pfm, bourke, mpcdi };

struct ConversionRequest {
    ConvertedKind kind = ConvertedKind::surfaceMap;
    std::vector<const Display*> displays;  // of the wall
    std::vector<std::string> paths;        // a file for each display; of an archive one for all
    std::string wallPath;                  // the wall file that names them; none beside an archive
    std::optional<glm::ivec2> grid{};      // nodes from border to border instead of one a pixel
};

struct ConvertedDisplay {
    std::string name;
    std::string path;
    glm::ivec2 nodes{0};
    ConversionError error;
};

// Writes the files, reads them back as any others and compares. No file of the wall is overwritten. All paths
// are in one folder; files appear there when all are complete. Throws UsageError for what a format cannot
// hold, and std::runtime_error where nothing can be written.
std::vector<ConvertedDisplay> convertWall(const Wall& wall, const ConversionRequest& request);

}  // namespace curvewall
