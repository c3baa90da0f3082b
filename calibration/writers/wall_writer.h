#pragma once
// Wall files, as docs/wall-file.md describes them, for what conversions write.

#include "calibration/wall.h"
#include "calibration/writers/bourke_writer.h"
#include "calibration/writers/ray_grid.h"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace curvewall {

// The entries of displays. Files are named without folders.
nlohmann::ordered_json cameraTextureEntry(const Display& display, const std::string& file,
                                          Alignment alignment, const Frustum& base);
nlohmann::ordered_json surfaceMapEntry(const Display& display, const std::string& file, Alignment alignment);
nlohmann::ordered_json bourkeEntry(const Display& display, const std::string& file,
                                   const FisheyeSource& source, bool hasIntensity);

// The whole file, as text.
std::string wallFile(const Wall& wall, const std::vector<nlohmann::ordered_json>& displays);

}  // namespace curvewall
